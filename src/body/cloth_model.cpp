#include "body/cloth_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "body/bending.hpp"
#include "body/collider_motion.hpp"
#include "mesh/disc.hpp"

namespace pliant {
namespace {

std::uint64_t sheet_measured_spring_count(std::uint64_t rows, std::uint64_t columns)
{
    const std::uint64_t structural = rows * (columns - 1) + (rows - 1) * columns;
    const std::uint64_t shear = 2 * (rows - 1) * (columns - 1);
    return structural + shear;
}

std::uint64_t sheet_spring_count(std::uint64_t rows, std::uint64_t columns)
{
    const std::uint64_t bend = rows * (columns - 2) + (rows - 2) * columns;
    return sheet_measured_spring_count(rows, columns) + bend;
}

Vec3d at(const std::vector<Vec3>& positions, std::uint32_t node) { return to_double(positions[node]); }

double distance(Vec3d a, Vec3d b) { return std::sqrt(dot(b - a, b - a)); }

double area(const std::vector<Vec3>& positions, const Triangle& t)
{
    const Vec3d n =
        cross(at(positions, t[1]) - at(positions, t[0]), at(positions, t[2]) - at(positions, t[0]));
    return 0.5 * std::sqrt(dot(n, n));
}

/// The nodes that a pin selects.
class PinnedNodes {
public:
    PinnedNodes(const ClothModel& model) : model_(model) {}

    std::vector<std::uint32_t> operator()(std::uint32_t index) const { return {model_.node(index)}; }
    std::vector<std::uint32_t> operator()(Corner corner) const
    {
        const std::uint32_t last_row = model_.sheet->rows - 1, last_column = model_.sheet->columns - 1;
        switch (corner) {
            case Corner::top_left: return {node(0, 0)};
            case Corner::top_right: return {node(0, last_column)};
            case Corner::bottom_left: return {node(last_row, 0)};
            case Corner::bottom_right: return {node(last_row, last_column)};
        }
        return {};
    }
    std::vector<std::uint32_t> operator()(Edge edge) const
    {
        const std::uint32_t rows = model_.sheet->rows, columns = model_.sheet->columns;
        const bool along_row = edge == Edge::top || edge == Edge::bottom;
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t k = 0; k < (along_row ? columns : rows); ++k)
            nodes.push_back(edge == Edge::top      ? node(0, k)
                            : edge == Edge::bottom ? node(rows - 1, k)
                            : edge == Edge::left   ? node(k, 0)
                                                   : node(k, columns - 1));
        return nodes;
    }
    std::vector<std::uint32_t> operator()(const Region& region) const
    {
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t i = 0; i < model_.node_count(); ++i) {
            const Vec3d p = at(model_.positions, i) + model_.origin;
            if (p.x >= region.min.x && p.x <= region.max.x && p.y >= region.min.y && p.y <= region.max.y &&
                p.z >= region.min.z && p.z <= region.max.z)
                nodes.push_back(i);
        }
        return nodes;
    }

private:
    std::uint32_t node(std::uint32_t row, std::uint32_t column) const
    {
        return row * model_.sheet->columns + column;
    }
    const ClothModel& model_;
};

/// m: the longest side of a mesh's bounding box at rest, and the mean length of its structural springs.
std::array<double, 2> sides_of(std::span<const Vec3> positions, std::span<const Spring> springs)
{
    double length = 0, side = 0;
    std::size_t count = 0;
    for (const Spring& spring : springs)
        if (spring.spring_class == SpringClass::structural) length += spring.rest_length, ++count;
    for (const float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        const auto [least, most] = std::minmax_element(positions.begin(), positions.end(),
                                                       [&](Vec3 a, Vec3 b) { return a.*axis < b.*axis; });
        if (least != positions.end()) side = std::max(side, double{*most.*axis} - double{*least.*axis});
    }
    if (!(length > 0) || !(side > 0)) return {1, 1};
    return {side, std::min(side, length / static_cast<double>(count))};
}

}  // namespace

ClothModel::ClothModel(const Cloth& cloth, const Scene& scene)
{
    if (const auto* options = std::get_if<SheetOptions>(&cloth.shape))
        build_sheet(cloth, *options);
    else if (cloth.body)
        build_body(cloth, scene);
    else if (const auto* disc = std::get_if<DiscOptions>(&cloth.shape))
        build_mesh(cloth, make_disc(disc->radius, disc->rings));
    else
        build_mesh(cloth, std::get<SurfaceMesh>(cloth.shape));
    velocities.assign(positions.size(), to_float(cloth.velocity));
    set_masses(cloth);
    set_pins(cloth);
    if (body) finish_body(cloth);

    set_springs(cloth, scene);
    parameters.gravity = scene.gravity;
    parameters.wind = scene.air.velocity;
    parameters.air_density = scene.air.density;
    parameters.drag = scene.air.drag;
    parameters.lift = scene.air.lift;
    parameters.damping = cloth.damping;
    parameters.thickness = cloth.thickness;
    meets_colliders = !scene.colliders.empty();

    const bool rows = uses_solver(method) && solver == Solver::paper;  // the paper's solver numbers springs
                                                                       // by rows
    const bool stages = integrator == Integrator::explicit_euler || integrator == Integrator::runge_kutta_4;
    const auto* sheet_options = std::get_if<SheetOptions>(&cloth.shape);
    graded = !body && (cloth.springs.bend_model == BendModel::quadratic ||
                       (sheet_options && sheet_options->border == SheetBorder::half));
    node_centric_ =
        is_sheet() && cloth.formulation != Formulation::spring_list && !rows && !stages && !graded;
    if (is_sheet() && !node_centric_) list_sheet_springs();
    if (!is_sheet() && !body) list_mesh_springs();
    if (graded) grade_springs(cloth);
    if (!node_centric_ && !body) list_neighbours();
    if (is_sheet()) {
        spring_count_ = sheet_spring_count(sheet->rows, sheet->columns);
        measured_spring_count_ = sheet_measured_spring_count(sheet->rows, sheet->columns);
    } else {
        spring_count_ = springs.size();
        measured_spring_count_ = static_cast<std::uint64_t>(
            std::count_if(springs.begin(), springs.end(),
                          [](const Spring& spring) { return spring.spring_class != SpringClass::bend; }));
    }
    if (is_sheet()) {
        const double along = (sheet->columns - 1) * sheet->rest_lengths[0],
                     down = (sheet->rows - 1) * sheet->rest_lengths[1];
        length_across = std::max(along, down);
        springs_across = std::max(sheet->rows, sheet->columns) - 1;
    } else {
        const auto [side, spring] = sides_of(positions, springs);
        length_across = side;
        springs_across = side / spring;
    }
    mean_mass = std::accumulate(masses.begin(), masses.end(), 0.0) / static_cast<double>(node_count());
    if (method == Method::acad && solver == Solver::newton_multigrid && scene.time.substeps > 0) {
        acad_implicit = 1 / (scene.time.frame_rate * scene.time.substeps) > stable_step();
        for (std::size_t k = 0; acad_implicit && k < spring_class_count; ++k) {
            limited[k].below = parameters.stiffness[k];
            limited[k].limit =
                acad.activate_at;  // a spring that is pulled to its rest length cannot also act as a spring
        }
    }
    // The paper's solver keeps springs in the order of the mesh; a body has been renumbered already.
    const bool keeps_order = body || (uses_solver(method) && solver == Solver::paper);
    if (const auto* mesh = std::get_if<SurfaceMesh>(&cloth.shape); mesh && !keeps_order)
        renumber(node_order(*mesh));
    if (uses_solver(method)) hierarchy = Hierarchy(*this);
}

void ClothModel::build_sheet(const Cloth& cloth, const SheetOptions& options)
{
    const double dx = options.width / (options.columns - 1), dz = options.height / (options.rows - 1);
    sheet = SheetShape{options.rows, options.columns, {dx, dz, std::sqrt(dx * dx + dz * dz), 2 * dx, 2 * dz}};
    const Rotation rotation = rotation_from_degrees(cloth.rotation);
    positions.reserve(std::size_t{options.rows} * options.columns);
    for (std::uint32_t row = 0; row < options.rows; ++row)
        for (std::uint32_t column = 0; column < options.columns; ++column) {
            const Vec3d flat = {column * dx - 0.5 * options.width, 0, row * dz - 0.5 * options.height};
            positions.push_back(to_float(cloth.position + rotate(rotation, flat)));
        }
}

void ClothModel::build_mesh(const Cloth& cloth, const SurfaceMesh& mesh)
{
    const Rotation rotation = rotation_from_degrees(cloth.rotation);
    positions.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices)
        positions.push_back(to_float(cloth.position + rotate(rotation, to_double(vertex) * cloth.scale)));
    triangles_ = mesh.triangles;
    list_node_triangles();
}

void ClothModel::list_node_triangles()
{
    node_triangles.start.assign(positions.size() + 1, 0);
    for (const Triangle& t : triangles_)
        for (const std::uint32_t node : t) ++node_triangles.start[node + 1];
    for (std::size_t i = 0; i < positions.size(); ++i) node_triangles.start[i + 1] += node_triangles.start[i];
    node_triangles.entries.resize(triangles_.size() * 3);
    std::vector<std::uint32_t> next(node_triangles.start.begin(), node_triangles.start.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (const std::uint32_t node : triangles_[t]) node_triangles.entries[next[node]++] = t;
}

void ClothModel::set_masses(const Cloth& cloth)
{
    constexpr double default_density = 0.3;  // kg/m2, a heavy cotton
    const std::size_t count = positions.size();
    std::vector<double> mass(count, 0.0);
    if (cloth.node_mass) {
        mass.assign(count, *cloth.node_mass);
    } else if (is_sheet()) {
        const auto& options = std::get<SheetOptions>(cloth.shape);
        const double total = cloth.density.value_or(default_density) * options.width * options.height;
        mass.assign(count, total / static_cast<double>(count));
        if (options.border == SheetBorder::half) share_by_area(mass, total, *sheet);
    } else {
        for (const Triangle& t : triangles_)
            for (const std::uint32_t node : t)
                mass[node] += cloth.density.value_or(default_density) * area(positions, t) / 3;
        for (std::size_t i = 0; i < count; ++i)
            if (!(mass[i] > 0))
                throw Error(ErrorKind::bad_input, "the mesh of cloth '" + cloth.name + "': vertex " +
                                                      std::to_string(i) +
                                                      " belongs to no triangle with an area, so its "
                                                      "mass would be 0; remove it from the "
                                                      "mesh, or give node_mass instead of density");
    }
    constexpr double least = 1e-18, most = 1e18;  // kg; beyond these a float has no accurate inverse
    for (std::size_t i = 0; i < count; ++i)
        if (!(mass[i] >= least && mass[i] <= most)) {
            char value[32];
            std::snprintf(value, sizeof value, "%.3g", mass[i]);
            throw Error(ErrorKind::bad_input, "cloth '" + cloth.name + "': node " + std::to_string(i) +
                                                  " has a mass of " + value +
                                                  " kg, and single precision can work with 1e-18 to 1e18 kg; "
                                                  "change density, node_mass or size");
        }
    masses = std::move(mass);
    pinned.assign(count, false);
}

void ClothModel::set_pins(const Cloth& cloth)
{
    const PinnedNodes nodes_of(*this);
    for (std::size_t p = 0; p < cloth.pins.size(); ++p) {
        const std::vector<std::uint32_t> nodes = std::visit(nodes_of, cloth.pins[p].where);
        if (nodes.empty())
            throw Error(ErrorKind::bad_input,
                        "cloth '" + cloth.name + "': pins[" + std::to_string(p) +
                            "] is a box that contains no node of the cloth; move or enlarge it");
        for (const std::uint32_t node : nodes) {
            pinned[node] = true;
            velocities[node] = {};
        }
        if (cloth.pins[p].keyframes.empty()) continue;
        Vec3d centre{};  // relative to the origin of the model, as positions are
        for (const std::uint32_t node : nodes)
            centre = centre + at(positions, node) * (1.0 / static_cast<double>(nodes.size()));
        for (const std::uint32_t node : nodes)
            attached.push_back(
                {node, static_cast<std::uint32_t>(motions.size()), at(positions, node) - centre});
        motions.push_back({centre, cloth.pins[p].keyframes});
    }
    // If several moving pins hold a node, it follows the last of them.
    std::stable_sort(attached.begin(), attached.end(),
                     [](const AttachedNode& a, const AttachedNode& b) { return a.node < b.node; });
    const auto last_of_node =
        std::unique(attached.rbegin(), attached.rend(),
                    [](const AttachedNode& a, const AttachedNode& b) { return a.node == b.node; });
    attached.erase(attached.begin(), last_of_node.base());
}

void ClothModel::place_attached(double time, std::span<Vec3> places) const
{
    std::vector<RigidMotion> now;
    for (const AttachmentMotion& motion : motions) now.push_back(motion_at(motion.keyframes, time));
    for (std::size_t k = 0; k < attached.size(); ++k) {
        const RigidMotion& motion = now[attached[k].motion];
        places[k] = to_float(motions[attached[k].motion].centre + motion.offset +
                             rotate(motion.rotation, attached[k].arm));
    }
}

bool ClothModel::remembers(SpringClass of) const
{
    return method == Method::constraint && solver == Solver::newton_multigrid &&
           newton.enforcement == Enforcement::multiplier && of != SpringClass::bend &&
           limited[static_cast<std::size_t>(of)].beyond > 0;
}

bool ClothModel::does_not_stretch(double step_length) const
{
    for (const SpringClass of : {SpringClass::structural, SpringClass::shear}) {
        const LimitedSprings& springs_of = limited[static_cast<std::size_t>(of)];
        const bool is_measured = springs_of.exists || is_sheet();
        if (is_measured && !(remembers(of) && springs_of.beyond > softest_limit(step_length))) return false;
    }
    return remembers_any();
}

double ClothModel::largest_limit() const
{
    double most = 0;
    for (const SpringClass of : {SpringClass::structural, SpringClass::shear})
        if (remembers(of)) most = std::max(most, limited[static_cast<std::size_t>(of)].limit);
    return most;
}

// A pull passes through n springs in a row at sqrt(k / m) springs per second. With one update per step it
// must pass in about half a step: k = 4.6 m n^2 / dt^2. Below a quarter of that the update itself is unstable
// (docs/physics.md). Cloth held up by colliders is pulled from all sides, and needs four times as much. In
// long steps the limit must bear the cloth's weight at once, m g n over n springs of length L / n, at a
// strain of 0.2 %.
double ClothModel::softest_limit(double step_length) const
{
    const double line = mean_mass * springs_across * springs_across;
    const double weight = std::sqrt(dot(parameters.gravity, parameters.gravity)) / length_across;
    // First-order updates are stable from a quarter of 4.6 on, second-order ones from 6.5 on
    // (docs/physics.md, "Constraints").
    const double firm = meets_colliders ? firm_limit : is_second_order() ? 13 : 4.6;
    return line * std::max(firm / (step_length * step_length), 500 * weight);
}

void ClothModel::set_springs(const Cloth& cloth, const Scene& scene)
{
    method = stepped_method(scene);
    integrator = scene.integrator;
    const bool implicit = integrator == Integrator::implicit_euler;
    solver = implicit ? Solver::newton_multigrid : scene.solver;
    newton = scene.newton_multigrid;
    paper = scene.paper;
    acad = scene.acad;
    SpringParameters classes[] = {cloth.springs.structural, cloth.springs.shear, cloth.springs.bend};
    if (cloth.body) {
        classes[1] = {cloth.body->internal.stiffness, cloth.body->internal.damping};
        classes[2] = {};
    }
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        const SpringParameters& given = classes[k];
        SpringRole role = given.role;
        if (role == SpringRole::automatic)
            role =
                method == Method::constraint && !implicit && k != static_cast<std::size_t>(SpringClass::bend)
                    ? SpringRole::constraint
                    : SpringRole::spring;
        const bool quadratic = !cloth.body && cloth.springs.bend_model == BendModel::quadratic;
        LimitedSprings& springs_of = limited[k];
        springs_of.exists = quadratic;  // all classes take part in bending
        if (role == SpringRole::off) continue;
        parameters.stiffness[k] = given.stiffness;
        parameters.spring_damping[k] = given.damping;
        springs_of.exists |= role == SpringRole::constraint || given.stiffness > 0 || given.damping > 0;
        if (method == Method::acad) {
            const bool to_rest = acad.target == AcadTarget::rest;
            springs_of.exists = true;
            springs_of.limit = to_rest ? 0 : acad.activate_at;
            springs_of.beyond = 1 / acad.compliance;
            springs_of.compressed = acad.compression || to_rest ? springs_of.beyond : 0;
        } else if (role == SpringRole::constraint) {
            springs_of.limit = given.limit;
            springs_of.below = given.limit > 0 ? given.stiffness : 0;
            springs_of.beyond = 1 / given.compliance;
            springs_of.compressed = newton.resists == Resists::both ? springs_of.beyond : 0;
            // A class without forces has no energy to report.
            if (solver == Solver::newton_multigrid) parameters.stiffness[k] = springs_of.below;
        } else {
            springs_of.below = given.stiffness;
        }
    }
}

/// Gives springs individual parameters. A sheet then becomes a mesh, since its grid has none.
void ClothModel::grade_springs(const Cloth& cloth)
{
    const bool quadratic = cloth.springs.bend_model == BendModel::quadratic;
    if (quadratic) {
        parameters.stiffness[2] = 0;
        limited[2] = {.exists = true};
    }
    const double bending = quadratic ? cloth.springs.bending_stiffness : 0;
    if (!is_sheet()) {
        spectrum_end = 6.2;
        return add_bending(springs, triangles_, positions, bending);
    }
    if (quadratic) spectrum_end = 4.2;
    if (std::get<SheetOptions>(cloth.shape).border == SheetBorder::half) halve_border(springs, *sheet);
    add_bending(springs, *sheet, bending);
    (void)triangles();
    list_node_triangles();
    sheet.reset();
}

void ClothModel::list_sheet_springs()
{
    // Forward neighbours are visited in ascending order for any number of columns, so the list is sorted by
    // (i, j).
    springs.reserve(sheet_spring_count(sheet->rows, sheet->columns));
    for_each_sheet_spring(*sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
        springs.push_back({i, j, n.spring_class, sheet->rest_lengths[static_cast<std::size_t>(n.rest)]});
    });
}

void ClothModel::list_mesh_springs()
{
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    const auto ordered = [](std::uint32_t a, std::uint32_t b) { return a < b ? Pair{a, b} : Pair{b, a}; };

    // Edges with their opposite vertices; sorted, so that all that follows has a fixed order.
    std::vector<std::pair<Pair, std::uint32_t>> sides;
    sides.reserve(triangles_.size() * 3);
    for (const Triangle& t : triangles_)
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] != t[(k + 1) % 3]) sides.emplace_back(ordered(t[k], t[(k + 1) % 3]), t[(k + 2) % 3]);
    std::sort(sides.begin(), sides.end());

    std::vector<Pair> edges, bends;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        if (s == 0 || sides[s].first != sides[s - 1].first)
            edges.push_back(sides[s].first);
        else if (sides[s].second != sides[s - 1].second)
            bends.push_back(ordered(sides[s].second, sides[s - 1].second));
    }
    std::sort(bends.begin(), bends.end());
    bends.erase(std::unique(bends.begin(), bends.end()), bends.end());

    const auto add = [&](Pair pair, SpringClass spring_class) {
        const double length = distance(at(positions, pair.first), at(positions, pair.second));
        if (length > 0) springs.push_back({pair.first, pair.second, spring_class, length});
    };
    for (const Pair& pair : edges) add(pair, SpringClass::structural);
    for (const Pair& pair : bends)
        if (!std::binary_search(edges.begin(), edges.end(), pair)) add(pair, SpringClass::bend);
    std::sort(springs.begin(), springs.end(),
              [](const Spring& a, const Spring& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
}

void ClothModel::list_neighbours()
{
    neighbours.start.assign(positions.size() + 1, 0);
    for (const Spring& spring : springs) {
        ++neighbours.start[spring.i + 1];
        ++neighbours.start[spring.j + 1];
    }
    for (std::size_t i = 0; i < positions.size(); ++i) neighbours.start[i + 1] += neighbours.start[i];
    neighbours.entries.resize(springs.size() * 2);
    std::vector<std::uint32_t> next(neighbours.start.begin(), neighbours.start.end() - 1);
    for (std::uint32_t s = 0; s < springs.size(); ++s) {
        neighbours.entries[next[springs[s].i]++] = {springs[s].j, s};
        neighbours.entries[next[springs[s].j]++] = {springs[s].i, s};
    }
    for (std::size_t i = 0; i < positions.size(); ++i)
        std::sort(neighbours.entries.begin() + neighbours.start[i],
                  neighbours.entries.begin() + neighbours.start[i + 1],
                  [](const Neighbour& a, const Neighbour& b) { return a.node < b.node; });
}

std::uint64_t ClothModel::triangle_count() const
{
    return is_sheet() ? 2ull * (sheet->rows - 1) * (sheet->columns - 1) : triangles_.size();
}

std::span<const Triangle> ClothModel::triangles() const
{
    if (is_sheet() && triangles_.empty()) {
        triangles_.reserve(triangle_count());
        for (std::uint32_t row = 0; row + 1 < sheet->rows; ++row)
            for (std::uint32_t column = 0; column + 1 < sheet->columns; ++column) {
                const std::uint32_t a = row * sheet->columns + column, b = a + 1;
                const std::uint32_t c = a + sheet->columns, d = c + 1;
                triangles_.push_back({a, c, b});
                triangles_.push_back({b, c, d});
            }
    }
    return triangles_;
}

double ClothModel::mass() const
{
    double sum = 0;
    for (const double m : masses) sum += m;
    return sum;
}

double ClothModel::shortest_rest_length() const
{
    if (is_sheet()) return *std::min_element(sheet->rest_lengths.begin(), sheet->rest_lengths.end());
    double shortest = std::numeric_limits<double>::infinity();
    for (const Spring& spring : springs) shortest = std::min(shortest, spring.rest_length);
    return shortest;
}

double ClothModel::stable_step() const
{
    // Row sums of norms of M^-1 K and M^-1 C, in 3 x 3 blocks, are at most 2 sum k / m and 2 sum c / m.
    std::vector<double> stiffness(positions.size(), 0.0), damping(positions.size(), 0.0);
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass spring_class, double scale,
                         double bending) {
        const auto k = static_cast<std::size_t>(spring_class);
        for (const std::uint32_t node : {i, j}) {
            stiffness[node] += scale * parameters.stiffness[k] + bending;
            damping[node] += scale * parameters.spring_damping[k];
        }
    };
    if (is_sheet())
        for_each_sheet_spring(*sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
            add(i, j, n.spring_class, 1, 0);
        });
    else
        for (const Spring& spring : springs)
            add(spring.i, spring.j, spring.spring_class, spring.scale, std::abs(spring.bending));

    double omega2 = 0, gamma = parameters.damping;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        omega2 = std::max(omega2, 2 * stiffness[i] * inverse_mass(i));
        gamma = std::max(gamma, parameters.damping + 2 * damping[i] * inverse_mass(i));
    }
    if (integrator ==
        Integrator::explicit_euler)  // |1 + lambda dt| < 1 while dt < gamma / omega2, gamma >= d
        return omega2 > 0 ? parameters.damping / omega2 : std::numeric_limits<double>::infinity();
    if (integrator == Integrator::runge_kutta_4) {
        // The stability region contains the left half of the disc of this radius; |lambda| <= max(omega,
        // gamma).
        constexpr double radius = 2.6;
        const double fastest = std::max(std::sqrt(omega2), gamma);
        return fastest > 0 ? radius / fastest : std::numeric_limits<double>::infinity();
    }
    // Symplectic Euler on x'' = -gamma x' - omega2 x is stable while 4 - 2 gamma dt - omega2 dt^2 > 0.
    if (omega2 > 0) return (std::sqrt(gamma * gamma + 4 * omega2) - gamma) / omega2;
    return gamma > 0 ? 2 / gamma : std::numeric_limits<double>::infinity();
}

}  // namespace pliant
