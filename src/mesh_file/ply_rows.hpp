// The rows of a PLY body, value by value: the same interface for text (PlyTextRows) and binary
// (PlyBinaryRows).
//   check_room(element)       throws if the rest of the file cannot hold the rows that the header claims
//   begin(element, row)       goes to the next row; its values are then read in the order of the properties
//   coordinate / list_length / integer / skip
//   end()                     throws unless the whole row has been read
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "files/formatted.hpp"
#include "mesh_file/ply_header.hpp"
#include "mesh_file/text_scan.hpp"

namespace pliant {

/// A row's name in messages: "vertex 17", counted from 0 as the indices of faces are.
struct PlyRowName {
    const PlyElement* element = nullptr;
    std::uint64_t row = 0;

    std::string text() const { return printable(element->name) + " " + std::to_string(row); }
    std::string of_all() const
    {
        return text() + " (of " + std::to_string(element->count) + ", the first is 0)";
    }
};

/// The message for a claimed count that is impossible.
inline std::string too_many_rows(const PlyElement& element, std::size_t bytes_left)
{
    return "element " + in_quotes(element.name) + " claims a count of " + std::to_string(element.count) +
           ", but the " + std::to_string(bytes_left) +
           " bytes left in the file cannot hold that; the file is cut short or its header is wrong";
}

class PlyTextRows {
public:
    PlyTextRows(const MeshSource& source, const PlyHeader& header)
        : source_(source), lines_(source.bytes, header.byte_count, header.line_count), words_({})
    {
    }

    void check_room(const PlyElement& element) const
    {
        // Every value takes a character and a separator, except for the last separator of the file.
        const std::size_t bytes_left = source_.bytes.size() - lines_.position();
        if (element.count > (bytes_left + 1) / (2 * element.properties.size()))
            mesh_error_at_line(source_, element.line, too_many_rows(element, bytes_left));
    }

    void begin(const PlyElement& element, std::uint64_t row)
    {
        name_ = {&element, row};
        do {
            if (!lines_.next())
                fail("the file ends before " + name_.of_all() + "; it is cut short or its header is wrong");
            words_ = WordScanner(lines_.line());
            first_ = words_.next();
        } while (first_.empty());
    }

    float coordinate(const PlyProperty& property)
    {
        const std::string_view word = next_word(property);
        const auto value = float_from(word);
        if (!value)
            fail("coordinate " + property.name + " of " + name_.text() + " is " + in_quotes(word) +
                 "; it must be a finite number of single precision");
        return *value;
    }

    std::uint64_t list_length(const PlyProperty& property)
    {
        const std::string_view word = next_word(property);
        const auto length = count_from(word);
        if (!length)
            fail("the length of list " + in_quotes(property.name) + " of " + name_.text() + " is " +
                 in_quotes(word) + "; it must be a whole number, not negative");
        return *length;
    }

    std::int64_t integer(const PlyProperty& property)
    {
        const std::string_view word = next_word(property);
        const auto value = integer_from(word);
        if (!value)
            fail("property " + in_quotes(property.name) + " of " + name_.text() + " has the value " +
                 in_quotes(word) + "; it must be a whole number");
        return *value;
    }

    void skip(const PlyProperty& property)
    {
        for (std::uint64_t left = property.length_type ? list_length(property) : 1; left > 0; --left) {
            const std::string_view word = next_word(property);
            if (!is_number(word))
                fail("property " + in_quotes(property.name) + " of " + name_.text() + " has the value " +
                     in_quotes(word) + "; it must be a number");
        }
    }

    void end()
    {
        const std::string_view word = words_.next();
        if (!word.empty())
            fail(name_.text() + " has more values than the header promises, from " + in_quotes(word) +
                 " on; compare the counts and properties of the header with the rows");
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        mesh_error_at_line(source_, lines_.number(), message);
    }
    const PlyRowName& name() const { return name_; }

private:
    std::string_view next_word(const PlyProperty& property)
    {
        const std::string_view word = first_.empty() ? words_.next() : first_;
        first_ = {};
        if (word.empty())
            fail("the line of " + name_.text() + " ends before its property " + in_quotes(property.name) +
                 "; a row must stand complete on one line");
        return word;
    }

    const MeshSource& source_;
    LineScanner lines_;
    WordScanner words_;
    std::string_view first_;  // of the line, which is read ahead to skip blank lines
    PlyRowName name_;
};

class PlyBinaryRows {
public:
    PlyBinaryRows(const MeshSource& source, const PlyHeader& header)
        : source_(source),
          position_(header.byte_count),
          swapped_((header.encoding == PlyEncoding::big_endian) != (std::endian::native == std::endian::big))
    {
    }

    void check_room(const PlyElement& element) const
    {
        std::size_t least = 0;  // bytes of a row with empty lists
        for (const PlyProperty& property : element.properties)
            least += byte_count(property.length_type.value_or(property.type));
        if (element.count > bytes_left() / least)
            mesh_error_at_byte(source_, position_, too_many_rows(element, bytes_left()));
    }

    void begin(const PlyElement& element, std::uint64_t row) { name_ = {&element, row}; }

    float coordinate(const PlyProperty& property)
    {
        const double value =
            with_type(property.type, [&](auto zero) { return static_cast<double>(next(zero)); });
        if (!(std::abs(value) <= double{std::numeric_limits<float>::max()}))
            fail("coordinate " + property.name + " of " + name_.text() + " is " + number_text(value) +
                 "; it must be a finite number of single precision");
        return static_cast<float>(value);
    }

    std::uint64_t list_length(const PlyProperty& property)
    {
        const std::int64_t length = integer_of(*property.length_type);
        const std::size_t fitting = bytes_left() / byte_count(property.type);
        if (length < 0 || static_cast<std::uint64_t>(length) > fitting)
            fail("list " + in_quotes(property.name) + " of " + name_.of_all() + " claims " +
                 std::to_string(length) + " values, but " + std::to_string(fitting) +
                 " fit into the rest of the file; the file is cut short or damaged");
        return static_cast<std::uint64_t>(length);
    }

    std::int64_t integer(const PlyProperty& property) { return integer_of(property.type); }

    void skip(const PlyProperty& property)
    {
        const std::uint64_t values = property.length_type ? list_length(property) : 1;
        advance(static_cast<std::size_t>(values) * byte_count(property.type));
    }

    void end() const {}

    [[noreturn]] void fail(const std::string& message) const { mesh_error_at_byte(source_, start_, message); }
    const PlyRowName& name() const { return name_; }

private:
    std::size_t bytes_left() const { return source_.bytes.size() - position_; }

    void advance(std::size_t bytes)
    {
        start_ = position_;
        if (bytes > bytes_left())
            fail("the file ends inside " + name_.of_all() + "; it is cut short or its header is wrong");
        position_ += bytes;
    }

    template <class Number>
    Number next(Number value)
    {
        advance(sizeof value);
        char bytes[sizeof value];
        std::memcpy(bytes, source_.bytes.data() + start_, sizeof value);
        if (swapped_) std::reverse(std::begin(bytes), std::end(bytes));
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }

    std::int64_t integer_of(PlyType type)  // the header and the layout guarantee an integer type
    {
        return with_type(type, [&](auto zero) { return static_cast<std::int64_t>(next(zero)); });
    }

    const MeshSource& source_;
    std::size_t position_;   // of the next value
    std::size_t start_ = 0;  // of the last value read, for messages
    bool swapped_;
    PlyRowName name_;
};

}  // namespace pliant
