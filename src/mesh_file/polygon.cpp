// Ear clipping: O'Rourke, Computational Geometry in C, 2nd edition, section 1.6. A corner's status as an ear
// changes only when a neighbour is cut off, hence n^2 at worst.
#include "mesh_file/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {

namespace {

struct Point {
    double x, y;
    friend bool operator==(const Point&, const Point&) = default;
};

/// Twice the signed area of a triangle: positive when it turns left.
double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Twice the area vector: a sum over all corners, so that reflex corners do not reverse it.
Vec3d doubled_area_vector(std::span<const std::uint32_t> polygon, const std::vector<Vec3>& vertices)
{
    const Vec3d origin = to_double(vertices[polygon[0]]);
    Vec3d normal;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        normal = normal + cross(to_double(vertices[polygon[i]]) - origin,
                                to_double(vertices[polygon[i + 1]]) - origin);
    return normal;
}

/// The polygon projected along the axis closest to its normal, counter-clockwise.
std::vector<Point> flattened(std::span<const std::uint32_t> polygon, const std::vector<Vec3>& vertices)
{
    const Vec3d normal = doubled_area_vector(polygon, vertices);
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    std::vector<Point> points;
    points.reserve(polygon.size());
    for (const std::uint32_t index : polygon) {
        const Vec3d v = to_double(vertices[index]);
        Point point = x >= y && x >= z ? Point{v.y, v.z} : y >= z ? Point{v.z, v.x} : Point{v.x, v.y};
        const double towards = x >= y && x >= z ? normal.x : y >= z ? normal.y : normal.z;
        if (towards < 0) std::swap(point.x, point.y);
        points.push_back(point);
    }
    return points;
}

bool strictly_convex(const std::vector<Point>& points)
{
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i)
        if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) <= 0) return false;
    return true;
}

/// A shrinking ring of corners from which ears are cut.
class EarClipper {
public:
    explicit EarClipper(std::vector<Point> points) : points_(std::move(points)), ring_(points_.size())
    {
        const std::size_t n = points_.size();
        for (std::size_t i = 0; i < n; ++i) ring_[i] = {(i + n - 1) % n, (i + 1) % n, false};
        for (std::size_t i = 0; i < n; ++i) ring_[i].ear = is_ear(i);
    }

    /// Calls `emit(a, b, c)` with the corners of each triangle.
    template <class Emit>
    void clip(Emit emit)
    {
        std::size_t left = points_.size(), at = 0, refused = 0;
        while (left > 3 && refused < left) {
            const Corner corner = ring_[at];
            if (!corner.ear) {
                ++refused;
                at = corner.next;
                continue;
            }
            emit(corner.previous, at, corner.next);
            ring_[corner.previous].next = corner.next;
            ring_[corner.next].previous = corner.previous;
            ring_[corner.previous].ear = is_ear(corner.previous);
            ring_[corner.next].ear = is_ear(corner.next);
            --left;
            refused = 0;
            at = ring_[corner.next].next;  // not next to the cut: fewer slivers than continuing at the same
                                           // tip
        }
        for (std::size_t i = ring_[at].next; ring_[i].next != at; i = ring_[i].next)
            emit(at, i, ring_[i].next);
    }

private:
    struct Corner {
        std::size_t previous = 0, next = 0;
        bool ear = false;
    };

    bool is_ear(std::size_t tip) const
    {
        const Corner corner = ring_[tip];
        const Point a = points_[corner.previous], b = points_[tip], c = points_[corner.next];
        if (turn(a, b, c) <= 0) return false;
        for (std::size_t i = ring_[corner.next].next; i != corner.previous; i = ring_[i].next) {
            const Point p = points_[i];
            // A point on the border blocks, too; one coincident with a, b or c (a bridge to a hole) does not.
            const bool blocks = turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
            if (blocks && p != a && p != b && p != c) return false;
        }
        return true;
    }

    std::vector<Point> points_;
    std::vector<Corner> ring_;
};

}  // namespace

bool append_triangles(std::span<const std::uint32_t> polygon, const std::vector<Vec3>& vertices,
                      std::vector<Triangle>& triangles)
{
    if (polygon.size() == 3) {
        triangles.push_back({polygon[0], polygon[1], polygon[2]});
        return true;
    }
    std::vector<Point> points = flattened(polygon, vertices);
    if (strictly_convex(points)) {
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
            triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
        return true;
    }
    if (polygon.size() > concave_corner_limit) return false;
    EarClipper(std::move(points)).clip([&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.push_back({polygon[a], polygon[b], polygon[c]});
    });
    return true;
}

}  // namespace pliant
