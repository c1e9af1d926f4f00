// OBJ reader: Wavefront, Advanced Visualizer manual, appendix B1. Reads the positions of 'v' and the corners
// of 'f'; skips the other statements of the format, and rejects anything else.
#include <algorithm>
#include <array>
#include <limits>

#include "mesh_file/mesh_formats.hpp"
#include "mesh_file/polygon.hpp"
#include "mesh_file/text_scan.hpp"

namespace pliant {

namespace {

constexpr auto stepped_over = std::to_array<std::string_view>({
    "vt",        "vn",     "vp",     "p",      "l",    "g",     "s",        "o",        "mg",
    "usemtl",    "mtllib", "usemap", "maplib", "lod",  "bevel", "c_interp", "d_interp", "shadow_obj",
    "trace_obj", "cstype", "deg",    "bmat",   "step", "curv",  "curv2",    "surf",     "parm",
    "trim",      "hole",   "scrv",   "sp",     "end",  "con",   "ctech",    "stech",    "bsp",
    "bzp",       "cdc",    "cdp",    "res",    "call", "csh",
});

class ObjReader {
public:
    explicit ObjReader(const MeshSource& source) : source_(source), lines_(text_of(source)) {}

    SurfaceMesh read()
    {
        while (next_statement()) {
            WordScanner words(statement_);
            const std::string_view keyword = words.next();
            if (keyword == "v")
                vertex(words);
            else if (keyword == "f")
                face(words);
            else if (!keyword.empty() && std::ranges::find(stepped_over, keyword) == stepped_over.end())
                fail("unknown statement " + in_quotes(keyword) + "; is it an OBJ file?");
        }
        if (mesh_.vertices.empty()) mesh_error(source_, "the mesh has no vertices; export it again");
        triangulate();
        return std::move(mesh_);
    }

private:
    static std::string_view text_of(const MeshSource& source)
    {
        constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
        std::string_view text = source.bytes;
        if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
        return text;
    }

    /// A line without its comment, joined with the next one if it ends in a backslash.
    bool next_statement()
    {
        if (!lines_.next()) return false;
        statement_line_ = lines_.number();
        statement_ = without_comment(lines_.line());
        if (!statement_.ends_with('\\')) return true;
        joined_ = statement_;
        while (joined_.ends_with('\\')) {
            joined_.back() = ' ';
            if (!lines_.next()) break;
            joined_ += without_comment(lines_.line());
        }
        statement_ = joined_;
        return true;
    }

    static std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

    /// v x y z [w] or v x y z r g b [a]; only the position is used.
    void vertex(WordScanner& words)
    {
        constexpr std::size_t most = 8;
        std::array<float, 3> position{};
        std::size_t count = 0;
        for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
            if (count == most) fail("the vertex has more than 8 numbers; write x, y and z");
            const auto value = float_from(word);
            if (!value)
                fail("number " + std::to_string(count + 1) + " of the vertex is " + in_quotes(word) +
                     "; it must be a finite number of single precision");
            if (count < 3) position[count] = *value;
        }
        if (count < 3) fail("the vertex has " + std::to_string(count) + " numbers; write x, y and z");
        if (mesh_.vertices.size() >= largest_index) fail("the mesh has more than 4294967294 vertices");
        mesh_.vertices.push_back({position[0], position[1], position[2]});
    }

    void face(WordScanner& words)
    {
        const std::size_t begin = faces_.corners.size();
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            faces_.corners.push_back(corner(word));
        const std::size_t corner_count = faces_.corners.size() - begin;
        if (corner_count < 3)
            fail("the face has " + std::to_string(corner_count) +
                 " corners; remove it, a face needs at least 3");
        faces_.ends.push_back(faces_.corners.size());
        face_lines_.push_back(statement_line_);
    }

    /// The index, from 0, in v, v/vt, v//vn or v/vt/vn. The upper bound is checked later, since faces may
    /// precede vertices.
    std::uint32_t corner(std::string_view word) const
    {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const auto index = integer_from(word.substr(0, slash));
        if (!index || !is_slash_tail(word.substr(slash)))
            fail("the corner " + in_quotes(word) +
                 " of the face is not of the form v, v/vt, v//vn or v/vt/vn");
        if (*index == 0) fail("the face uses vertex 0; vertices of OBJ files are numbered from 1");
        const auto before = static_cast<std::int64_t>(mesh_.vertices.size());
        if (*index < -before)
            fail("the face uses vertex " + std::to_string(*index) + ", but only " + std::to_string(before) +
                 " vertices precede it; correct the index");
        if (*index > largest_index)
            fail("the face uses vertex " + std::to_string(*index) +
                 ", more than any mesh can have; correct the index");
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : before + *index);
    }

    /// "", "/", "/vt", "//vn", "/vt/", "/vt/vn" with whole numbers.
    static bool is_slash_tail(std::string_view tail)
    {
        int slashes = 0;
        while (!tail.empty()) {
            if (++slashes > 2) return false;
            tail.remove_prefix(1);
            const std::size_t end = std::min(tail.find('/'), tail.size());
            if (end > 0 && !integer_from(tail.substr(0, end))) return false;
            tail.remove_prefix(end);
        }
        return true;
    }

    void triangulate()
    {
        mesh_.triangles.reserve(faces_.corners.size() - 2 * faces_.count());
        for (std::size_t i = 0; i < faces_.count(); ++i) {
            statement_line_ = face_lines_[i];
            const auto polygon = faces_.polygon(i);
            for (const std::uint32_t index : polygon)
                if (index >= mesh_.vertices.size())
                    fail("the face uses vertex " + std::to_string(std::uint64_t{index} + 1) +
                         ", but the vertices are 1 to " + std::to_string(mesh_.vertices.size()) +
                         "; correct the index");
            if (!append_triangles(polygon, mesh_.vertices, mesh_.triangles))
                fail("the face has " + std::to_string(polygon.size()) +
                     " corners and is not convex; triangulate the mesh first: the limit is " +
                     std::to_string(concave_corner_limit) + " corners");
        }
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        mesh_error_at_line(source_, statement_line_, message);
    }

    static constexpr std::uint32_t largest_index = std::numeric_limits<std::uint32_t>::max() - 1;

    const MeshSource& source_;
    LineScanner lines_;
    std::string joined_;  // the text of a statement over several lines
    std::string_view statement_;
    std::size_t statement_line_ = 0;
    SurfaceMesh mesh_;
    Polygons faces_;
    std::vector<std::size_t> face_lines_;
};

}  // namespace

SurfaceMesh read_obj(const MeshSource& source) { return ObjReader(source).read(); }

}  // namespace pliant
