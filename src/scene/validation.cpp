// Validates a scene, whatever its origin: the ranges of fields.hpp, then the relations between fields.
#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/disc.hpp"
#include "scene/fields.hpp"

namespace pliant {
namespace scene_format {
namespace {

std::string vector_text(const Vec3d& v)
{
    return "[" + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + "]";
}

std::uint64_t node_count(const Cloth& cloth)
{
    if (const auto* sheet = std::get_if<SheetOptions>(&cloth.shape))
        return std::uint64_t{sheet->rows} * sheet->columns;
    if (const auto* disc = std::get_if<DiscOptions>(&cloth.shape)) return disc_node_count(disc->rings);
    return std::get<SurfaceMesh>(cloth.shape).vertices.size();
}

/// Visits the fields of a scene and throws FieldError for the first invalid one.
class Checker {
public:
    explicit Checker(std::string path) : path_(std::move(path)) {}

    template <class Thing>
    void check(const Thing& thing)
    {
        fields(*this, thing);
        relations(thing);
    }

    void number(const char* key, double value, const Range& range, const char* unit, Presence = {}) const
    {
        require_number(member_path(path_, key), value, range, unit, NumberKind::real);
    }
    void number(const char* key, std::uint32_t value, const Range& range, const char* unit,
                Presence = {}) const
    {
        require_number(member_path(path_, key), value, range, unit, NumberKind::whole);
    }
    void number(const char* key, std::optional<double> value, const Range& range, const char* unit) const
    {
        if (value) number(key, *value, range, unit);
    }
    void vector(const char* key, const Vec3d& value, const Range& range, const char* unit,
                Presence = {}) const
    {
        const std::string path = member_path(path_, key);
        const double elements[] = {value.x, value.y, value.z};
        for (std::size_t i = 0; i < 3; ++i)
            require_number(element_path(path, i), elements[i], range, unit, NumberKind::real);
    }
    template <class Enumeration>
    void choice(const char* key, Enumeration value, Names names) const
    {
        const auto index = static_cast<std::size_t>(value);
        require(index < names.size(), key,
                "is no. " + std::to_string(index) + ", " + expected_choice("", names));
    }
    void flag(const char*, bool) const {}
    void text(const char*, const std::string&) const {}
    void name(const char* key, const std::string& value) const
    {
        constexpr std::size_t longest = 64;
        const bool usable =
            !value.empty() && value.size() <= longest && value.front() != '.' &&
            std::none_of(value.begin(), value.end(), [](char c) {
                return c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20U || c == 0x7F;
            });
        require(usable, key,
                "is " + in_quotes(value) +
                    ", but must be 1 to 64 characters that can name a file: no leading "
                    "dot, no slash, no control character");
    }

    template <class Inside>
    void nested(const char* key, Inside inside, Presence = {}) const
    {
        Checker child(member_path(path_, key));
        inside(child);
    }
    template <class Thing>
    void object(const char* key, const Thing& thing) const
    {
        nested(key, [&](Checker& child) { child.check(thing); });
    }
    template <class Thing>
    void object(const char* key, const std::optional<Thing>& thing) const
    {
        if (thing) object(key, *thing);
    }
    template <class Thing>
    void list(const char* key, const std::vector<Thing>& things) const
    {
        for (std::size_t i = 0; i < things.size(); ++i)
            Checker(element_path(member_path(path_, key), i)).check(things[i]);
    }
    template <class Variant, class With>
    void one_of(const Variant& variant, Names keys, With with) const
    {
        std::visit([&](const auto& alternative) { with(keys[variant.index()], alternative); }, variant);
    }

    void format_version(const char*) const {}
    void material(const char* key, const Cloth& cloth) const { choice(key, cloth.material, material_names); }
    void step_length(const char*, const TimeOptions&) const {}
    void mesh_file(const char*, const SurfaceMesh& mesh) const
    {
        const auto finite = [](const Vec3& v) {
            return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
        };
        if (mesh.triangles.empty()) fail("has no triangle, but a cloth needs at least one");
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            if (!finite(mesh.vertices[i]))
                fail("has a coordinate that is not finite at vertex " + std::to_string(i));
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t vertex : mesh.triangles[i])
                if (vertex >= mesh.vertices.size())
                    fail("has the vertex " + std::to_string(vertex) + " in triangle " + std::to_string(i) +
                         ", but only " + std::to_string(mesh.vertices.size()) + " vertices");
    }
    void body_shape(Names, const Cloth& cloth) const
    {
        if (const auto* mesh = std::get_if<SurfaceMesh>(&cloth.shape))
            nested("mesh", [&](const Checker& inside) { inside.mesh_file("file", *mesh); });
        else
            fail("is a soft body of a sheet or disc, but needs a closed mesh");
        require_number(member_path(path_, "mesh.scale"), cloth.scale, extent, "", NumberKind::real);
    }
    void cloths(const char* key, const Scene& scene) const
    {
        for (std::size_t i = 0, number = 0; i < scene.cloth_count(); ++i)
            if (!scene.cloth(i).is_body())
                Checker(element_path(member_path(path_, key), number++)).check(scene.cloth(i));
    }
    void bodies(const char* key, const Scene& scene) const
    {
        for (std::size_t i = 0, number = 0; i < scene.cloth_count(); ++i) {
            if (!scene.cloth(i).is_body()) continue;
            const Checker inside(element_path(member_path(path_, key), number++));
            body_fields(inside, scene.cloth(i));
            inside.body_relations(scene.cloth(i), scene.method);
        }
    }
    void checks(const char* key, const std::vector<Check>& checks) const
    {
        for (const Check& check : checks) {
            const std::string path = member_path(member_path(path_, key), check.value);
            if (std::find(check_names.begin(), check_names.end(), check.value) == check_names.end())
                throw FieldError(path, unknown_name(check.value, check_names));
            if (!(std::isfinite(check.min) && std::isfinite(check.max) && check.min <= check.max))
                throw FieldError(path, "is [" + number_text(check.min) + ", " + number_text(check.max) +
                                           "], but must be [min, max], finite and in this order");
        }
    }

private:
    [[noreturn]] void fail(const std::string& problem) const { throw FieldError(path_, problem); }
    void require(bool condition, const std::string& key, const std::string& problem) const
    {
        if (!condition) throw FieldError(member_path(path_, key), problem);
    }

    template <class Thing>
    void relations(const Thing& thing) const
    {
        if constexpr (requires { thing.keyframes; }) relations(thing.keyframes);
    }

    void relations(const std::vector<Keyframe>& keyframes) const
    {
        for (std::size_t i = 1; i < keyframes.size(); ++i)
            require(keyframes[i].time > keyframes[i - 1].time, element_path("keyframes", i) + ".time",
                    "is " + number_text(keyframes[i].time) +
                        " s, but must be later than the keyframe before it, " +
                        number_text(keyframes[i - 1].time) + " s");
    }

    /// Values over time: ascending times, values within their range.
    void timed(const char* key, const std::vector<TimedValue>& values, const Range& range,
               const char* unit) const
    {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::string path = element_path(key, i);
            require_number(member_path(path_, path + ".value"), values[i].value, range, unit,
                           NumberKind::real);
            require(i == 0 || values[i].time > values[i - 1].time, path + ".time",
                    "is " + number_text(values[i].time) + " s, but must be later than the one before it");
        }
    }

    void relations(const VolumeOptions& volume) const
    {
        timed("target", volume.target, {0.01, 100}, "");
        timed("pressure", volume.pressure, {-1e9, 1e9}, "Pa");
        require(
            !volume.focus || volume.weights.empty(), "focus",
            "is given beside weights of the vertices, but only one of them can say where the volume is kept");
        for (const float weight : volume.weights)
            require(weight >= 0 && weight <= 1, "weights",
                    "has " + number_text(double{weight}) + ", but a weight must be between 0 and 1");
    }

    void body_relations(const Cloth& cloth, Method method) const
    {
        require(!(cloth.density && cloth.node_mass), "node_mass",
                "is given beside density, but only one of them can say what the body weighs");
        const std::vector<float>& weights = cloth.body->volume.weights;
        require(weights.empty() || weights.size() == node_count(cloth), "volume.weights",
                "has " + std::to_string(weights.size()) + " weights, but the mesh has " +
                    std::to_string(node_count(cloth)) + " vertices");
        require(cloth.formulation != Formulation::spring_list ||
                    (method == Method::mass_spring && cloth.body->volume.pressure.empty()),
                "formulation",
                "is spring_list, but volume and pressure need what node_centric gathers: use automatic");
        require(method == Method::mass_spring || method == Method::volume, "springs",
                "are stepped by the methods mass_spring and volume alone, but the method of the scene is " +
                    std::string(name_of(method)));
        for (std::size_t i = 0; i < cloth.pins.size(); ++i)
            relations(cloth, cloth.pins[i].where, element_path("pins", i));
    }

    void relations(const Plane& plane) const
    {
        require(dot(plane.normal, plane.normal) > 0, "normal",
                "is [0, 0, 0], but must point away from the solid side");
        relations(plane.keyframes);
    }

    void relations(const Camera& camera) const
    {
        require(camera.position != camera.target, "target",
                "is " + vector_text(camera.target) + " m, but must differ from the camera's position");
    }

    void relations(const Region& region) const
    {
        const bool ordered =
            region.min.x <= region.max.x && region.min.y <= region.max.y && region.min.z <= region.max.z;
        require(ordered, "min",
                "is " + vector_text(region.min) + " m, but must not exceed max, " + vector_text(region.max) +
                    " m, in any coordinate");
    }

    void relations(const Cloth& cloth) const
    {
        const auto* sheet = std::get_if<SheetOptions>(&cloth.shape);
        require(!(cloth.density && cloth.node_mass), "node_mass",
                "is given beside density, but only one of them can say what the cloth weighs");
        require(!sheet || !(sheet->density || sheet->node_mass), "sheet.density",
                "is set inside the shape, but the density and node_mass of the cloth itself are what counts");
        const auto* disc = std::get_if<DiscOptions>(&cloth.shape);
        require(!disc || !(disc->density || disc->node_mass), "disc.density",
                "is set inside the shape, but the density and node_mass of the cloth itself are what counts");
        require(!disc || cloth.scale == 1, "scale",
                "is " + number_text(cloth.scale) + ", but only a mesh has a scale: a disc has its radius");
        require(sheet || cloth.formulation != Formulation::node_centric, "formulation",
                "is node_centric, but a mesh needs spring_list or automatic");
        for (std::size_t i = 0; i < cloth.pins.size(); ++i)
            relations(cloth, cloth.pins[i].where, element_path("pins", i));
    }

    void relations(const Cloth& cloth, const Pin& pin, const std::string& key) const
    {
        const bool sheet = std::holds_alternative<SheetOptions>(cloth.shape);
        if (const auto* index = std::get_if<std::uint32_t>(&pin))
            require(*index < node_count(cloth), key + ".index",
                    "is " + std::to_string(*index) + ", but the nodes of this cloth are 0 to " +
                        std::to_string(node_count(cloth) - 1));
        require(sheet || !std::holds_alternative<Corner>(pin), key + ".corner",
                "is on a mesh, but only a sheet has named corners: use index or box");
        require(sheet || !std::holds_alternative<Edge>(pin), key + ".edge",
                "is on a mesh, but only a sheet has named edges: use index or box");
    }

    void relations(const AcadOptions& acad) const
    {
        require(acad.deactivate_at.value_or(0) <= acad.activate_at, "deactivate_at",
                "is " + number_text(acad.deactivate_at.value_or(0)) + ", but must not exceed activate_at, " +
                    number_text(acad.activate_at));
    }

    /// A class of springs can be a constraint only with a method that supports it.
    void roles(const Springs& springs, Method method, const std::string& cloth) const
    {
        const std::pair<const char*, SpringRole> classes[] = {{"structural", springs.structural.role},
                                                              {"shear", springs.shear.role},
                                                              {"bend", springs.bend.role}};
        const std::string reason =
            method == Method::acad
                ? std::string("the method acad makes its own constraints of springs")
                : "the method " + std::string(name_of(method)) + " has no constraints of springs";
        for (const auto& [name, role] : classes)
            require(role != SpringRole::constraint || method == Method::constraint,
                    cloth + ".springs." + name + ".role",
                    "is constraint, but " + reason + ": use method constraint");
    }

    /// Features with parameters for single springs, which not every kind of step supports.
    void graded_springs(const Cloth& cloth, const Scene& scene, const std::string& path) const
    {
        const auto* sheet = std::get_if<SheetOptions>(&cloth.shape);
        const bool quadratic = cloth.springs.bend_model == BendModel::quadratic;
        const bool half = sheet && sheet->border == SheetBorder::half;
        const std::string key = path + (quadratic ? ".springs.bend_model" : ".sheet.border");
        const std::string value = quadratic ? "is quadratic" : "is half";
        if (!quadratic && !half) return;
        require(cloth.formulation != Formulation::node_centric, key,
                value + ", which needs springs with numbers of their own: use formulation automatic");
        require(!uses_paper_solver(scene), key,
                value + ", which the solver paper does not know: use newton_multigrid");
        require(!quadratic || cloth.springs.bend.role != SpringRole::constraint, path + ".springs.bend.role",
                "is constraint, but with bend_model quadratic there are no bend springs: use automatic");
    }
    static bool uses_paper_solver(const Scene& scene)
    {
        return scene.solver == Solver::paper &&
               (scene.method == Method::constraint || scene.method == Method::acad);
    }

    void integrator(const Scene& scene) const
    {
        if (scene.integrator == Integrator::symplectic_euler) return;
        const std::string value = std::string("is ") + name_of(scene.integrator);
        require(scene.method == Method::mass_spring, "integrator",
                value + ", but the method " + std::string(name_of(scene.method)) +
                    " has a way of its own to step: use method mass_spring");
        for (std::size_t i = 0; i < scene.cloth_count(); ++i) {
            require(!scene.cloth(i).is_body(), "integrator",
                    value + ", but soft bodies are stepped by symplectic_euler alone");
            require(scene.integrator == Integrator::implicit_euler ||
                        scene.cloth(i).formulation != Formulation::node_centric,
                    element_path("cloths", i) + ".formulation",
                    "is node_centric, but the integrator " + std::string(name_of(scene.integrator)) +
                        " needs spring_list or automatic");
        }
        require(
            scene.integrator != Integrator::explicit_euler || scene.time.substeps > 0, "time.substeps",
            "is 0, but the integrator explicit_euler has no safe step that could be chosen: give a number "
            "of at least 1");
    }

    void relations(const Scene& scene) const
    {
        integrator(scene);
        require(scene.cloth_count() > 0, "cloths",
                "is empty, but a scene needs at least one cloth, or one of bodies");
        std::uint64_t total = 0;
        std::size_t cloths = 0, bodies = 0;
        for (std::size_t i = 0; i < scene.cloth_count(); ++i) {
            const bool body = scene.cloth(i).is_body();
            const std::string path = element_path(body ? "bodies" : "cloths", body ? bodies++ : cloths++);
            if (!body) roles(scene.cloth(i).springs, scene.method, path);
            if (!body) graded_springs(scene.cloth(i), scene, path);
            total += node_count(scene.cloth(i));
            require(total <= max_nodes, path,
                    "brings the scene to " + std::to_string(total) + " nodes, but there may be at most " +
                        std::to_string(max_nodes) + " nodes");
        }
    }

    std::string path_;
};

}  // namespace
}  // namespace scene_format

void validate(const Scene& scene) { scene_format::Checker("").check(scene); }

}  // namespace pliant
