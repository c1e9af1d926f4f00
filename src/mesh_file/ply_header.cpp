#include "mesh_file/ply_header.hpp"

#include <array>
#include <utility>

#include "mesh_file/text_scan.hpp"

namespace pliant {

namespace {

constexpr std::array type_names = {
    std::pair{"char", PlyType::int8},       std::pair{"uchar", PlyType::uint8},
    std::pair{"short", PlyType::int16},     std::pair{"ushort", PlyType::uint16},
    std::pair{"int", PlyType::int32},       std::pair{"uint", PlyType::uint32},
    std::pair{"float", PlyType::float32},   std::pair{"double", PlyType::float64},
    std::pair{"int8", PlyType::int8},       std::pair{"uint8", PlyType::uint8},
    std::pair{"int16", PlyType::int16},     std::pair{"uint16", PlyType::uint16},
    std::pair{"int32", PlyType::int32},     std::pair{"uint32", PlyType::uint32},
    std::pair{"float32", PlyType::float32}, std::pair{"float64", PlyType::float64},
};

class PlyHeaderParser {
public:
    explicit PlyHeaderParser(const MeshSource& source) : source_(source), lines_(source.bytes) {}

    PlyHeader parse()
    {
        lines_.next();
        if (WordScanner(lines_.line()).next() != "ply")
            fail("a PLY file begins with the line 'ply', but this one begins with " +
                 in_quotes(lines_.line()) + "; is it another kind of file?");
        while (lines_.next()) {
            WordScanner words(lines_.line());
            const std::string_view keyword = words.next();
            if (keyword == "end_header") return finished(words);
            if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
            if (keyword == "format")
                format(words);
            else if (keyword == "element")
                element(words);
            else if (keyword == "property")
                property(words);
            else
                fail("unknown keyword " + in_quotes(keyword) + " in the header; remove the line");
        }
        fail("the file ends inside its header, before the line 'end_header'; export the mesh again");
    }

private:
    PlyHeader finished(WordScanner& words)
    {
        no_more(words);
        if (!format_seen_) fail("the header has no 'format' line; add one such as 'format ascii 1.0'");
        header_.byte_count = lines_.position();
        header_.line_count = lines_.number();
        return std::move(header_);
    }

    void format(WordScanner& words)
    {
        if (std::exchange(format_seen_, true)) fail("the header has a second 'format' line; remove one");
        const std::string_view name = required(words, "name");
        if (name == "ascii")
            header_.encoding = PlyEncoding::ascii;
        else if (name == "binary_little_endian")
            header_.encoding = PlyEncoding::little_endian;
        else if (name == "binary_big_endian")
            header_.encoding = PlyEncoding::big_endian;
        else
            fail("unknown format " + in_quotes(name) +
                 "; the formats are ascii, binary_little_endian and binary_big_endian");
        const std::string_view version = required(words, "version");
        if (version != "1.0") fail("unknown format version " + in_quotes(version) + "; only 1.0 exists");
        no_more(words);
    }

    void element(WordScanner& words)
    {
        PlyElement element;
        element.line = lines_.number();
        element.name = required(words, "name");
        const std::string_view count = required(words, "count");
        const auto number = count_from(count);
        if (!number)
            fail("the count of element " + in_quotes(element.name) + " is " + in_quotes(count) +
                 "; it must be a whole number, not negative and below 2^64");
        element.count = *number;
        no_more(words);
        header_.elements.push_back(std::move(element));
    }

    void property(WordScanner& words)
    {
        if (header_.elements.empty()) fail("a 'property' line stands before the first 'element' line");
        PlyProperty property;
        property.line = lines_.number();
        std::string_view type = required(words, "type");
        if (type == "list") {
            property.length_type = type_from(required(words, "type"));
            if (!is_integer(*property.length_type))
                fail("the length of a list has a floating-point type; use an integer type such as uchar");
            type = required(words, "type");
        }
        property.type = type_from(type);
        property.name = required(words, "name");
        no_more(words);
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type_from(std::string_view name) const
    {
        for (const auto& [known, type] : type_names)
            if (name == known) return type;
        fail("unknown type " + in_quotes(name) +
             "; the types are char, uchar, short, ushort, int, uint, float, double and int8 to float64");
    }

    std::string_view required(WordScanner& words, const std::string& what) const
    {
        const std::string_view word = words.next();
        if (word.empty()) fail("the header line ends before its " + what + "; export the mesh again");
        return word;
    }

    void no_more(WordScanner& words) const
    {
        const std::string_view word = words.next();
        if (!word.empty())
            fail("unexpected " + in_quotes(word) + " at the end of the header line; remove it");
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        mesh_error_at_line(source_, lines_.number(), message);
    }

    const MeshSource& source_;
    LineScanner lines_;
    PlyHeader header_;
    bool format_seen_ = false;
};

}  // namespace

PlyHeader read_ply_header(const MeshSource& source) { return PlyHeaderParser(source).parse(); }

}  // namespace pliant
