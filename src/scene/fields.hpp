// Every field of a scene, once: its key in a file, its place in the Scene, its range and its unit.
//
// `fields(at, thing)` passes the fields of an object to a visitor: the ObjectReader fills them from JSON, the
// Checker of validation.cpp checks their values, a test compares them with scenes/scene.schema.json. A
// visitor provides:
//
//   number, vector, choice, flag, name, text    one value
//   nested(key, inside)                   an object; `inside` passes its fields to the visitor of that object
//   object(key, thing)                    the same for an object that has `fields`
//   list(key, things)                     an array of such objects
//   one_of(variant, keys, with)           exactly one of the keys, which names the alternative
//   and fields whose form in a file differs from the Scene: format_version, step_length, mesh_file,
//   body_shape, material, cloths, bodies, checks
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "pliant/mesh_generators.hpp"
#include "pliant/scene.hpp"
#include "scene/field.hpp"

namespace pliant::scene_format {

enum class Presence { optional, required };
inline constexpr Presence required = Presence::required;

// Names in the order of their enumerations.
inline constexpr std::array method_names{"mass_spring", "constraint", "acad", "volume"};
inline constexpr std::array integrator_names{"symplectic_euler", "explicit_euler", "runge_kutta_4",
                                             "implicit_euler"};
inline constexpr std::array bend_model_names{"skip_spring", "quadratic"};
inline constexpr std::array material_names{"none", "cotton", "silk", "denim", "wool", "leather", "rubber"};
inline constexpr std::array border_names{"full", "half"};
inline constexpr std::array solver_names{"newton_multigrid", "paper"};
inline constexpr std::array role_names{"automatic", "spring", "constraint", "off"};
inline constexpr std::array preconditioner_names{"multigrid", "jacobi", "none"};
inline constexpr std::array enforcement_names{"multiplier", "penalty"};
inline constexpr std::array resists_names{"tension", "both"};
inline constexpr std::array target_names{"threshold", "rest"};
inline constexpr std::array formulation_names{"automatic", "node_centric", "spring_list"};
inline constexpr std::array response_names{"coulomb", "paper"};
inline constexpr std::array colour_names{"checker", "strain"};
inline constexpr std::array corner_names{"top_left", "top_right", "bottom_left", "bottom_right"};
inline constexpr std::array edge_names{"top", "bottom", "left", "right"};
inline constexpr std::array internal_names{"none", "opposite", "nearest"};
// Keys in the order of their variants' alternatives.
inline constexpr std::array shape_keys{"sheet", "mesh", "disc"};
inline constexpr std::array body_shape_keys{"mesh", "icosphere", "uv_sphere", "torus",
                                            "box",  "capsule",   "blob"};
inline constexpr std::array pin_keys{"index", "corner", "edge", "box"};
inline constexpr std::array collider_keys{"sphere", "plane", "box", "capsule", "tapered_capsule"};
/// Numbers of the summary that a scene's check may use.
inline constexpr std::array check_names{"max_stretch",
                                        "max_stretch_peak",
                                        "mean_stretch",
                                        "max_penetration",
                                        "finite",
                                        "frames",
                                        "steps",
                                        "nodes",
                                        "springs",
                                        "triangles",
                                        "kinetic_energy",
                                        "elastic_energy",
                                        "simulated_seconds",
                                        "real_time_factor",
                                        "lowest_height",
                                        "highest_height",
                                        "solver.newton_mean",
                                        "solver.iterations_mean",
                                        "solver.iterations_max",
                                        "solver.residual_max",
                                        "solver.energy_lost",
                                        "solver.active_max",
                                        "volume_error_max",
                                        "volume_loss_max",
                                        "volume_gain_max",
                                        "volume_loss_mean",
                                        "volume_ratio_final"};

inline constexpr std::uint32_t max_nodes = 16'777'216;  // 2^24: exact in a float
constexpr auto longest_side = max_nodes / 2;            // of a sheet with two rows
constexpr std::uint32_t most_rings = 2364;              // of a disc: 1 + 3 rings (rings + 1) nodes

// Beyond these, single precision gives no meaningful result; they keep every sum and product finite.
inline constexpr Range coordinate{-1e6, 1e6};
inline constexpr Range extent = above(0, 1e6);
inline constexpr Range angle{-1e6, 1e6};
inline constexpr Range fraction{0, 1};
/// Of a constraint: below 1e-9 m/N its force is lost in single-precision rounding; above 1 it has no effect.
inline constexpr Range compliance{1e-9, 1};

/// An object of type Type, const or not.
template <class Thing, class Type>
concept Is = std::same_as<std::remove_const_t<Thing>, Type>;

void fields(auto& at, Is<TimeOptions> auto& time)
{
    at.number("duration", time.duration, above(0, 1e6), "s");
    at.number("frame_rate", time.frame_rate, {1, 10'000}, "1/s");
    at.number("substeps", time.substeps, {0, 100'000}, "steps");
    at.step_length("dt", time);  // an alternative to frame_rate
}

void fields(auto& at, Is<Air> auto& air)
{
    at.vector("velocity", air.velocity, {-1e3, 1e3}, "m/s");
    at.number("density", air.density, {0, 2'000}, "kg/m3");
    at.number("drag", air.drag, {0, 100}, "");
    at.number("lift", air.lift, {0, 100}, "");
}

void fields(auto& at, Is<Camera> auto& camera)
{
    at.vector("position", camera.position, coordinate, "m");
    at.vector("target", camera.target, coordinate, "m");
    at.number("field_of_view", camera.field_of_view, {1, 170}, "degrees");
    at.number("width", camera.width, {16, 8192}, "pixels");
    at.number("height", camera.height, {16, 8192}, "pixels");
    at.choice("colour", camera.colour, colour_names);
}

void fields(auto& at, Is<SpringParameters> auto& springs)
{
    at.number("stiffness", springs.stiffness, {0, 1e9}, "N/m");
    at.number("damping", springs.damping, {0, 1e6}, "N s/m");
    at.choice("role", springs.role, role_names);
    at.number("limit", springs.limit, fraction, "");
    at.number("compliance", springs.compliance, compliance, "m/N");
    at.number("rest_scale", springs.rest_scale, {0.1, 10}, "");
}

void fields(auto& at, Is<Springs> auto& springs)
{
    at.object("structural", springs.structural);
    at.object("shear", springs.shear);
    at.object("bend", springs.bend);
    at.choice("bend_model", springs.bend_model, bend_model_names);
    at.number("bending_stiffness", springs.bending_stiffness, {0, 1e6}, "N m");
}

void fields(auto& at, Is<SheetOptions> auto& sheet)
{
    at.number("rows", sheet.rows, {2, longest_side}, "nodes", required);
    at.number("columns", sheet.columns, {2, longest_side}, "nodes", required);
    at.number("width", sheet.width, extent, "m");
    at.number("height", sheet.height, extent, "m");
    at.choice("border", sheet.border, border_names);
}

void fields(auto& at, Is<SurfaceMesh> auto& mesh) { at.mesh_file("file", mesh); }

void fields(auto& at, Is<DiscOptions> auto& disc)
{
    at.number("radius", disc.radius, extent, "m");
    at.number("rings", disc.rings, {1, most_rings}, "rings of nodes", required);
}

void fields(auto& at, Is<Region> auto& region)
{
    at.vector("min", region.min, coordinate, "m", required);
    at.vector("max", region.max, coordinate, "m", required);
}

void pin_field(auto& at, const char* key, Is<std::uint32_t> auto& index)
{
    at.number(key, index, {0, max_nodes - 1}, "");
}
void pin_field(auto& at, const char* key, Is<Corner> auto& corner) { at.choice(key, corner, corner_names); }
void pin_field(auto& at, const char* key, Is<Edge> auto& edge) { at.choice(key, edge, edge_names); }
void pin_field(auto& at, const char* key, Is<Region> auto& region) { at.object(key, region); }

void fields(auto& at, Is<Keyframe> auto& keyframe)
{
    at.number("time", keyframe.time, {0, 1e6}, "s", required);
    at.vector("position", keyframe.position, coordinate, "m");
    at.vector("rotation", keyframe.rotation, angle, "degrees");
}

void fields(auto& at, Is<Attachment> auto& pin)
{
    at.one_of(pin.where, pin_keys, [&](const char* key, auto& where) { pin_field(at, key, where); });
    at.list("keyframes", pin.keyframes);
}

void fields(auto& at, Is<Cloth> auto& cloth)
{
    at.name("name", cloth.name);
    at.one_of(cloth.shape, shape_keys, [&](const char* key, auto& shape) {
        at.nested(key, [&](auto& inside) {
            fields(inside, shape);
            if constexpr (Is<std::remove_reference_t<decltype(shape)>, SurfaceMesh>)
                inside.number("scale", cloth.scale, extent, "");
        });
    });
    at.material("material", cloth);  // first, so that keys beside it override it
    at.number("density", cloth.density, above(0, 1e6), "kg/m2");
    at.number("node_mass", cloth.node_mass, above(0, 1e6), "kg");
    at.vector("position", cloth.position, coordinate, "m");
    at.vector("rotation", cloth.rotation, angle, "degrees");
    at.vector("velocity", cloth.velocity, {-1e4, 1e4}, "m/s");
    at.object("springs", cloth.springs);
    at.choice("formulation", cloth.formulation, formulation_names);
    at.number("damping", cloth.damping, {0, 1'000}, "1/s");
    at.number("thickness", cloth.thickness, {0, 1}, "m");
    at.list("pins", cloth.pins);
}

// Shapes of soft bodies; the generators check relations between their numbers.
inline constexpr Range generated_length = above(0, 1e4);

void fields(auto& at, Is<IcosphereOptions> auto& sphere)
{
    at.number("radius", sphere.radius, generated_length, "m");
    at.number("frequency", sphere.frequency, {1, 1024}, "parts of an edge");
}

void fields(auto& at, Is<UvSphereOptions> auto& sphere)
{
    at.number("radius", sphere.radius, generated_length, "m");
    at.number("rings", sphere.rings, {2, 4096}, "bands");
    at.number("segments", sphere.segments, {3, 8192}, "around");
}

void fields(auto& at, Is<TorusOptions> auto& torus)
{
    at.number("major_radius", torus.major_radius, generated_length, "m");
    at.number("minor_radius", torus.minor_radius, generated_length, "m");
    at.number("major_segments", torus.major_segments, {3, 8192}, "around");
    at.number("minor_segments", torus.minor_segments, {3, 8192}, "around");
}

void fields(auto& at, Is<BoxOptions> auto& box)
{
    at.vector("size", box.size, generated_length, "m");
    at.number("faces", box.faces, {1, 1024}, "squares");
}

void fields(auto& at, Is<CapsuleOptions> auto& capsule)
{
    at.number("radius", capsule.radius, generated_length, "m");
    at.number("length", capsule.length, generated_length, "m");
    at.number("cap_rings", capsule.cap_rings, {1, 4096}, "bands");
    at.number("bands", capsule.bands, {1, 4096}, "bands");
    at.number("segments", capsule.segments, {3, 8192}, "around");
}

void fields(auto& at, Is<BlobOptions> auto& blob)
{
    at.number("height", blob.height, generated_length, "m");
    at.number("vertices", blob.vertices, {1'000, 500'000}, "vertices");
}

void fields(auto& at, Is<InternalSprings> auto& springs)
{
    at.choice("kind", springs.kind, internal_names);
    at.number("neighbours", springs.neighbours, {1, 64}, "springs");
    at.number("most", springs.most, {0, 100'000'000}, "springs");
    at.number("stiffness", springs.stiffness, {0, 1e9}, "N/m");
    at.number("damping", springs.damping, {0, 1e6}, "N s/m");
}

void fields(auto& at, Is<TimedValue> auto& value)
{
    at.number("time", value.time, {0, 1e6}, "s", required);
    at.number("value", value.value, {-1e9, 1e9}, "", required);
}

void fields(auto& at, Is<VolumeFocus> auto& focus)
{
    at.vector("centre", focus.centre, coordinate, "m", required);
    at.number("radius", focus.radius, extent, "m", required);
}

void fields(auto& at, Is<VolumeOptions> auto& volume)
{
    at.flag("constraint", volume.constraint);
    at.number("tolerance", volume.tolerance, {1e-7, 1}, "");
    at.list("target", volume.target);
    at.list("pressure", volume.pressure);
    at.object("focus", volume.focus);
}

void fields(auto& at, Is<RegionForce> auto& force)
{
    at.nested(
        "box", [&](auto& inside) { fields(inside, force.box); }, required);
    at.vector("force", force.force, {-1e9, 1e9}, "N");
    at.vector("torque", force.torque, {-1e9, 1e9}, "N m");
}

/// A cloth as a soft body: the same object with other keys.
void body_fields(auto& at, Is<Cloth> auto& cloth)
{
    at.name("name", cloth.name);
    at.body_shape(body_shape_keys, cloth);
    at.number("density", cloth.density, above(0, 1e6), "kg/m2");
    at.number("node_mass", cloth.node_mass, above(0, 1e6), "kg");
    at.vector("position", cloth.position, coordinate, "m");
    at.vector("rotation", cloth.rotation, angle, "degrees");
    at.vector("velocity", cloth.velocity, {-1e4, 1e4}, "m/s");
    at.nested("springs", [&](auto& inside) {
        inside.number("stiffness", cloth.springs.structural.stiffness, {0, 1e9}, "N/m");
        inside.number("damping", cloth.springs.structural.damping, {0, 1e6}, "N s/m");
        inside.object("internal", cloth.body->internal);
    });
    at.choice("formulation", cloth.formulation, formulation_names);
    at.object("volume", cloth.body->volume);
    at.list("forces", cloth.body->forces);
    at.number("damping", cloth.damping, {0, 1'000}, "1/s");
    at.number("thickness", cloth.thickness, {0, 1}, "m");
    at.list("pins", cloth.pins);
}

void contact_fields(auto& at, auto& shape)
{
    at.number("friction", shape.friction, {0, 10}, "");
    at.choice("response", shape.response, response_names);
    at.list("keyframes", shape.keyframes);
}

void fields(auto& at, Is<Sphere> auto& sphere)
{
    at.vector("centre", sphere.centre, coordinate, "m", required);
    at.number("radius", sphere.radius, extent, "m", required);
    contact_fields(at, sphere);
}

void fields(auto& at, Is<Plane> auto& plane)
{
    at.vector("point", plane.point, coordinate, "m");
    at.vector("normal", plane.normal, {-1e6, 1e6}, "");
    contact_fields(at, plane);
}

void fields(auto& at, Is<Box> auto& box)
{
    at.vector("centre", box.centre, coordinate, "m", required);
    at.vector("size", box.size, extent, "m", required);
    at.vector("rotation", box.rotation, angle, "degrees");
    contact_fields(at, box);
}

void fields(auto& at, Is<Capsule> auto& capsule)
{
    at.vector("start", capsule.start, coordinate, "m", required);
    at.vector("end", capsule.end, coordinate, "m", required);
    at.number("radius", capsule.radius, extent, "m", required);
    contact_fields(at, capsule);
}

void fields(auto& at, Is<TaperedCapsule> auto& capsule)
{
    at.vector("start", capsule.start, coordinate, "m", required);
    at.vector("end", capsule.end, coordinate, "m", required);
    at.number("start_radius", capsule.start_radius, extent, "m", required);
    at.number("end_radius", capsule.end_radius, extent, "m", required);
    contact_fields(at, capsule);
}

void fields(auto& at, Is<Collider> auto& collider)
{
    at.one_of(collider, collider_keys, [&](const char* key, auto& shape) { at.object(key, shape); });
}

void fields(auto& at, Is<NewtonMultigridOptions> auto& solver)
{
    at.number("newton_iterations", solver.newton_iterations, {1, 1'000}, "iterations");
    at.number("newton_tolerance", solver.newton_tolerance, fraction, "");
    at.number("linear_iterations", solver.linear_iterations, {1, 10'000}, "V-cycles");
    at.number("linear_tolerance", solver.linear_tolerance, fraction, "");
    at.number("step_cuts", solver.step_cuts, {0, 8}, "");
    at.number("smoothing", solver.smoothing, {1, 8}, "");
    at.number("order", solver.order, {1, 2}, "");
    at.choice("preconditioner", solver.preconditioner, preconditioner_names);
    at.choice("enforcement", solver.enforcement, enforcement_names);
    at.choice("resists", solver.resists, resists_names);
    at.number("contact_stiffness", solver.contact_stiffness, {0, 1e9}, "N/m");
    at.number("friction_speed", solver.friction_speed, above(0, 1), "m/s");
}

void fields(auto& at, Is<PaperOptions> auto& solver)
{
    at.number("tolerance", solver.tolerance, above(0, 1), "");
    at.number("max_iterations", solver.max_iterations, {1, 100'000}, "iterations");
    at.number("compliance", solver.compliance, {0, 1}, "m/N");
}

void fields(auto& at, Is<AcadOptions> auto& acad)
{
    at.number("activate_at", acad.activate_at, above(0, 1), "");
    at.number("deactivate_at", acad.deactivate_at, fraction, "");
    at.flag("compression", acad.compression);
    at.choice("target", acad.target, target_names);
    at.number("compliance", acad.compliance, compliance, "m/N");
}

void fields(auto& at, Is<Scene> auto& scene)
{
    at.format_version("pliant");
    at.name("name", scene.name);
    at.text("description", scene.description);
    at.choice("method", scene.method, method_names);
    at.choice("integrator", scene.integrator, integrator_names);
    at.choice("solver", scene.solver, solver_names);
    at.object("newton_multigrid", scene.newton_multigrid);
    at.object("paper", scene.paper);
    at.object("acad", scene.acad);
    at.object("time", scene.time);
    at.vector("gravity", scene.gravity, {-1e4, 1e4}, "m/s2");
    at.object("air", scene.air);
    at.cloths("cloths", scene);
    at.bodies("bodies", scene);
    at.list("colliders", scene.colliders);
    at.object("camera", scene.camera);
    at.checks("check", scene.checks);
}

}  // namespace pliant::scene_format
