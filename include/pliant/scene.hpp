// The input of a simulation: cloths, colliders, air and gravity. SI units everywhere; y is up.
//
// A Scene is plain data with a few builders. `read_scene` fills the same structure from a scene file
// (docs/scenes.md), and `validate` checks it.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "pliant/api.hpp"
#include "pliant/error.hpp"
#include "pliant/mesh.hpp"
#include "pliant/vec3.hpp"

namespace pliant {

/// Corners of a sheet: "top" is row 0, "left" is column 0.
enum class Corner { top_left, top_right, bottom_left, bottom_right };
/// Edges of a sheet: "top" is row 0, "left" is column 0.
enum class Edge { top, bottom, left, right };
/// An axis-aligned region of the scene. It selects the nodes that are inside or on its border before the
/// first step.
struct Region {
    Vec3d min, max;  ///< m
};
/// The nodes of a pin: a node index (unsigned, row by row on a sheet), a named corner or edge of a sheet, or
/// every node in a region.
using Pin = std::variant<std::uint32_t, Corner, Edge, Region>;
/// The types from which a pin can be made.
template <class Where>
concept PinLike = std::constructible_from<Pin, Where>;

/// Position and rotation at a time; interpolated linearly in between.
struct Keyframe {
    double time = 0;      ///< s, increasing
    Vec3d position = {};  ///< m, added to the object's own
    Vec3d rotation = {};  ///< degrees about x, then y, then z, around the object's centre
};

/// A pin and its motion. It converts from everything that a pin can be made of, without motion:
/// `cloth.pin(Corner::top_left)`. A moving one is `cloth.pin({Edge::left, {{.time = 0}, {.time = 2, .position
/// = {0.1, 0, 0}}}})`.
struct Attachment {
    Attachment() = default;
    template <PinLike Where>
    Attachment(Where&& node_or_place, std::vector<Keyframe> motion = {})  // NOLINT: implicit; not a copy
        : where(std::forward<Where>(node_or_place)), keyframes(std::move(motion))
    {
    }

    Pin where;
    /// Empty: it does not move. Rotations are about the centre (the mean) of the pin's nodes at the start.
    std::vector<Keyframe> keyframes = {};
};

/// The method that steps cloth.
enum class Method {
    mass_spring,  ///< springs alone, with explicit steps (the cloth paper, section 2)
    constraint,   ///< structural and shear springs are inextensible beyond their limit, with implicit steps
    acad,         ///< springs become constraints while they are too long (the cloth paper)
    volume,       ///< springs with explicit steps, and one volume constraint for each soft body
};
/// Time integration of springs, for the method mass_spring.
enum class Integrator {
    symplectic_euler,  ///< first the velocity, then the position with it: order 1, bounded energy
    explicit_euler,    ///< both from the previous state: order 1, gains energy in every step
    runge_kutta_4,     ///< four evaluations of the forces per step: order 4
    implicit_euler,  ///< forces at the end of the step, by the solver newton_multigrid: order 1, loses energy
};
/// The solver of constraints, for the methods constraint and acad.
enum class Solver {
    newton_multigrid,  ///< Newton's method on the step's energy; linear systems by multigrid V-cycles
    paper,             ///< conjugate gradients for the Lagrange multipliers, as in the cloth paper
};
/// The role of a class of springs.
enum class SpringRole {
    /// With the method constraint, structural and shear springs are constraints and bend springs are springs;
    /// with other methods, all are springs.
    automatic,
    spring,      ///< force by stiffness and damping
    constraint,  ///< enforces its length; only with the method constraint
    off,         ///< no force, whatever its other parameters
};
/// The direction in which a constraint acts.
enum class Resists {
    tension,  ///< only against being longer than at rest, as a thread
    both,     ///< also against being shorter, as a rod
};

/// Stiffness and damping of one class of springs, and whether it is a constraint.
///
/// A constraint with limit 0 pulls with (l - l0) / compliance as soon as it is longer than l0; its stiffness
/// is not used. With a limit above 0 it is a spring with its stiffness up to that strain (and under
/// compression); beyond the limit the compliance acts in addition.
struct SpringParameters {
    double stiffness = 0;  ///< N/m, 0 to 1e9; 0 together with damping 0: no force
    double damping = 0;    ///< N s/m, 0 to 1e6
    SpringRole role = SpringRole::automatic;
    double limit = 0;          ///< of a constraint: strain (l - l0) / l0 at which it begins to act, 0 to 1;
                               ///< 0.01 is 1 %
    double compliance = 1e-6;  ///< m/N of a constraint beyond its limit, 1e-9 to 1
    /// 0.1 to 10, multiplies the rest lengths that the shape at the start has: below 1 the cloth contracts,
    /// as an elastic hem does, and above 1 it buckles.
    double rest_scale = 1;
};

/// The model of bending.
enum class BendModel {
    skip_spring,  ///< the papers' springs to every second node; they have no stiffness at the flat state
    /// B/2 (sum of the principal curvatures)^2 per area, quadratic for inextensible shapes, flat at rest.
    /// Replaces the stiffness of bend springs.
    quadratic,
};

/// The three classes of the cloth paper (section 2.1). On a triangle mesh, structural springs are the edges,
/// and a bend spring connects the two vertices opposite an interior edge; there are no shear springs.
struct Springs {
    SpringParameters structural{1000.0, 0.01};
    SpringParameters shear{500.0,
                           0.01};  ///< half the structural stiffness makes a sheet isotropic (nu = 1/3)
    SpringParameters bend{10.0, 0.001};
    BendModel bend_model = BendModel::skip_spring;
    double bending_stiffness = 1e-5;  ///< N m, 0 to 1e6: B of bend_model quadratic
};

/// The material of a cloth: density, stiffnesses and bending stiffness of a real fabric.
enum class Material { none, cotton, silk, denim, wool, leather, rubber };
/// The properties of a material; docs/scenes.md has their sources.
struct MaterialProperties {
    double density = 0;  ///< kg/m2
    double stretch = 0;  ///< N/m, tension over strain along a thread
    double shear = 0;    ///< N/m, of the shear modulus
    double bending = 0;  ///< N m
};
PLIANT_API const MaterialProperties& properties_of(Material material);

/// How spring forces are computed; both forms give the same bits.
enum class Formulation {
    automatic,     ///< node-centric on sheets, spring list on meshes
    node_centric,  ///< each node gathers its (at most 12) springs; sheets only
    spring_list,   ///< the papers' edge-centric form: one force per spring, gathered per node without atomics
};

/// The treatment of a sheet's border.
enum class SheetBorder {
    full,  ///< all nodes have the same mass, and springs along the border are as stiff as inner ones
    /// A node has the mass of the cloth around it, and springs along the border are half as stiff: the sheet
    /// then has the constants of the continuum at every resolution.
    half,
};

/// A rectangular sheet of `rows` x `columns` nodes, flat and at rest, in the x-z plane.
struct SheetOptions {
    std::uint32_t rows = 2;     ///< nodes, >= 2; row 0 is the "top", at negative z
    std::uint32_t columns = 2;  ///< nodes, >= 2; column 0 is the "left", at negative x
    double width = 1.0;         ///< m, along a row (x before rotation)
    double height = 1.0;        ///< m, along a column (z before rotation)
    SheetBorder border = SheetBorder::full;
    std::optional<double> density = {};    ///< kg/m2; 0.3 if neither this nor node_mass is given
    std::optional<double> node_mass = {};  ///< kg per node, instead of density
};

/// A round cloth, flat and at rest, in the x-z plane: an irregular triangle mesh of 1 + 3 rings (rings + 1)
/// nodes. Node 0 is in the middle, and the last 6 rings nodes are its hem.
struct DiscOptions {
    double radius = 0.5;                   ///< m
    std::uint32_t rings = 32;              ///< 1 to 2364, of nodes around the middle one
    std::optional<double> density = {};    ///< kg/m2; 0.3 if neither this nor node_mass is given
    std::optional<double> node_mass = {};  ///< kg per node, instead of density
};

/// A cloth of any shape.
struct MeshOptions {
    std::optional<double> density = {};    ///< kg/m2; 0.3 if neither this nor node_mass is given
    std::optional<double> node_mass = {};  ///< kg per node, instead of density
    double scale = 1.0;                    ///< multiplies the coordinates of the mesh
};

/// The internal springs of a soft body.
enum class InternalKind {
    none,
    opposite,  ///< from each vertex to the one nearest to where its inward normal leaves the body
    nearest,   ///< from each vertex to the nearest ones that face it across the inside
};
/// Springs inside a soft body; without them only its surface resists.
struct InternalSprings {
    InternalKind kind = InternalKind::none;
    std::uint32_t neighbours = 1;  ///< of nearest: 1 to 64 for each vertex
    std::uint32_t most = 0;        ///< maximum number of springs; each vertex's first choice has priority; 0:
                                   ///< all
    double stiffness = 1000;       ///< N/m, 0 to 1e9
    double damping = 0.01;         ///< N s/m, 0 to 1e6
};

/// A value at a time; interpolated linearly in between, constant before the first and after the last.
struct TimedValue {
    double time = 0;   ///< s, increasing
    double value = 1;  ///< of a target: V / V0, 0.01 to 100; of a pressure: Pa
};

/// The nodes that the volume constraint of a soft body moves: eq. (15) of the volume paper, corrected. A node
/// at the distance d of `centre` has the weight (cos(pi d / radius) + 1) / 2, and 0 beyond `radius`.
struct VolumeFocus {
    Vec3d centre;       ///< m, in the scene, before the first step
    double radius = 1;  ///< m
};

/// The volume of a soft body.
struct VolumeOptions {
    bool constraint = true;  ///< for the method volume; false: springs and pressure only
    /// 1e-7 to 1: a step after which abs(V / V_target - 1) is above this counts in VolumeReport::misses.
    double tolerance = 1e-4;
    std::vector<TimedValue> target;    ///< V / V0 over time; empty: 1
    std::vector<TimedValue> pressure;  ///< Pa, excess pressure inside; empty: 0
    std::optional<VolumeFocus> focus;  ///< none: all nodes have the same weight
    std::vector<float> weights;        ///< one per vertex, 0 to 1, instead of a focus; empty: none
};

/// A force and a torque on the nodes in a region, from the first step on.
struct RegionForce {
    Region box;
    Vec3d force;   ///< N, divided equally among the nodes
    Vec3d torque;  ///< N m about the middle of the nodes at the start; divided so that all turn alike
};

/// Options of a soft body: a cloth whose mesh is a closed surface.
struct BodyOptions {
    InternalSprings internal;
    VolumeOptions volume;
    std::vector<RegionForce> forces;
};

/// One piece of cloth, or the surface of a soft body: rest shape, material and pins.
struct PLIANT_API Cloth {
    static Cloth sheet(const SheetOptions& options);
    static Cloth mesh(SurfaceMesh mesh, const MeshOptions& options = {});
    static Cloth disc(const DiscOptions& options);
    /// A soft body: `mesh` must be closed and face outward. Its springs are `springs.structural`, along the
    /// edges, and `body->internal`.
    static Cloth soft_body(SurfaceMesh mesh, const BodyOptions& body = {}, const MeshOptions& options = {});
    bool is_body() const { return body.has_value(); }

    Cloth& pin(const Attachment& attachment)
    {
        pins.push_back(attachment);
        return *this;
    }
    /// Sets density and springs to those of a material, with bend_model quadratic; later assignments override
    /// it. With the method constraint, structural springs have the material's extensibility.
    Cloth& make_of(Material given);

    std::string name = "cloth";
    std::variant<SheetOptions, SurfaceMesh, DiscOptions> shape;
    /// kg/m2; a sheet distributes its mass equally, a mesh by the area around a vertex. 0.3 if neither this
    /// nor node_mass is set. `sheet` and `disc` move the density of their options here; in `shape` itself it
    /// must be empty.
    std::optional<double> density;
    std::optional<double> node_mass;     ///< kg per node, instead of density
    Material material = Material::none;  ///< set by `make_of`; only density and springs are used
    double scale = 1.0;                  ///< of a mesh
    Vec3d position;                      ///< m, place of the shape's origin (the centre of a sheet)
    Vec3d rotation;                      ///< degrees about x, then y, then z
    Vec3d velocity;                      ///< m/s, of every node at the start
    Springs springs;
    Formulation formulation = Formulation::automatic;
    double damping = 0.1;      ///< 1/s; every velocity loses this fraction per second
    double thickness = 0.002;  ///< m; distance that contact keeps between a node and a collider
    std::vector<Attachment> pins;
    std::optional<BodyOptions> body;  ///< of a soft body
};

/// The response of a collider to a node that enters it.
enum class ContactResponse {
    coulomb,  ///< removes the approaching normal velocity, applies Coulomb friction, keeps the rest
    paper,    ///< Algorithm 4 of the cloth paper as printed (its result does not have the unit of a velocity;
              ///< see docs/physics.md)
};

// friction: Coulomb's coefficient, 0 to 10. keyframes: empty: it does not move. The shapes are aggregates for
// designated initialisers: {.centre = {0, 0.4, 0}, .radius = 0.3, .friction = 0.4}
struct Sphere {
    Vec3d centre = {};    ///< m
    double radius = 0.5;  ///< m
    double friction = 0.3;
    ContactResponse response = ContactResponse::coulomb;
    std::vector<Keyframe> keyframes = {};
};
/// A half-space: everything on the side against the normal is solid.
struct Plane {
    Vec3d point = {};          ///< m
    Vec3d normal = {0, 1, 0};  ///< any length
    double friction = 0.3;
    ContactResponse response = ContactResponse::coulomb;
    std::vector<Keyframe> keyframes = {};
};
struct Box {
    Vec3d centre = {};       ///< m
    Vec3d size = {1, 1, 1};  ///< m, full edge lengths
    Vec3d rotation = {};     ///< degrees about x, then y, then z
    double friction = 0.3;
    ContactResponse response = ContactResponse::coulomb;
    std::vector<Keyframe> keyframes = {};
};
struct Capsule {
    Vec3d start = {}, end = {};  ///< m, the centres of the two half-spheres
    double radius = 0.1;         ///< m
    double friction = 0.3;
    ContactResponse response = ContactResponse::coulomb;
    std::vector<Keyframe> keyframes = {};
};
/// A capsule that is thicker at one end, as an arm or a finger: the hull of two spheres. Where one sphere
/// contains the other, it is that sphere.
struct TaperedCapsule {
    Vec3d start = {}, end = {};  ///< m, the centres of the two spheres
    double start_radius = 0.1;   ///< m
    double end_radius = 0.05;    ///< m
    double friction = 0.3;
    ContactResponse response = ContactResponse::coulomb;
    std::vector<Keyframe> keyframes = {};
};
using Collider = std::variant<Sphere, Plane, Box, Capsule, TaperedCapsule>;

/// Moving air: forces on triangles by their velocity relative to the air. Off if `density` is 0.
struct Air {
    Vec3d velocity = {};  ///< m/s, the wind
    double density = 0;   ///< kg/m3; 1.2 for air
    double drag = 1.0;    ///< coefficient, along the relative wind
    double lift = 0.5;    ///< coefficient, across the relative wind
};

/// The preconditioner of conjugate gradients in the solver newton_multigrid.
enum class Preconditioner {
    multigrid,  ///< a V-cycle over a hierarchy of coarser cloths
    jacobi,     ///< the diagonal blocks alone; for comparison
    none,       ///< plain conjugate gradients; for comparison
};

/// How the solver newton_multigrid enforces limits.
enum class Enforcement {
    multiplier,  ///< each spring keeps its force from step to step, and a soft stiffness corrects it
    penalty,     ///< by the stiffness 1 / compliance alone; for comparison
};

/// The solver newton_multigrid: each step minimises its incremental potential (Martin et al. 2011,
/// Example-Based Elastic Materials, section 4) by Newton's method.
struct NewtonMultigridOptions {
    std::uint32_t newton_iterations = 8;  ///< 1 to 1000: maximum per step; for ACAD four times as many. Three
                                          ///< times as many while the residual is above 1
    /// 0 to 1: a step is solved if its residual has fallen to this fraction of the step's load (what inertia
    /// and gravity ask of it), both in the norm of the energy; 0 never stops early.
    double newton_tolerance = 0.3;
    std::uint32_t linear_iterations = 4;  ///< 1 to 10,000: maximum V-cycles per Newton iteration
    double linear_tolerance = 0.2;  ///< 0 to 1: the same for each linear system, relative to the smaller of
                                    ///< the load and its own initial residual
    /// 0 to 8: how many times the steps of a frame may be divided by three if one was not solved (a residual
    /// above 1).
    std::uint32_t step_cuts = 2;
    std::uint32_t smoothing = 1;  ///< 1 to 8: degree of the smoother before and after each level
    /// 1 or 2, order in time. 1: implicit Euler, which damps oscillations strongly. 2: BDF2, the two-step
    /// backward differentiation formula, which hardly damps them. It needs steps of equal length; other
    /// steps, and those of nodes in contact, are of order 1. At order 2 tolerances are a third.
    std::uint32_t order = 1;
    Preconditioner preconditioner = Preconditioner::multigrid;
    Enforcement enforcement = Enforcement::multiplier;
    Resists resists = Resists::tension;  ///< of all constraints
    /// N/m, 0 to 1e9: of a node against a collider; 0: a hundred times its mass over the step squared. It
    /// only corrects the normal force, which each node keeps from step to step.
    double contact_stiffness = 0;
    /// m/s, above 0 to 1: below this speed of sliding, friction grows linearly with it; Coulomb's law
    /// regularised as by Li et al. 2020, Incremental Potential Contact, section 5.
    double friction_speed = 1e-3;
};

/// The paper's solver: conjugate gradients on the system of the Lagrange multipliers (Va, Choi, Hong 2021).
struct PaperOptions {
    double tolerance = 1e-4;             ///< above 0 to 1: relative residual at which a step is solved
    std::uint32_t max_iterations = 200;  ///< 1 to 100,000: of conjugate gradients, in a step
    double compliance = 0;               ///< m/N, 0 to 1: of every constraint; 0: inextensible
};

/// The length to which an active constraint of the method acad pulls its spring.
enum class AcadTarget {
    threshold,  ///< the length at which it became one, l0 (1 + activate_at)
    rest,       ///< the rest length, l0
};
/// The method acad: a spring that is too long is a constraint in that step.
struct AcadOptions {
    double activate_at = 0.10;  ///< above 0 to 1: strain (l - l0) / l0 beyond which a spring is a constraint
    /// 0 to activate_at, which is the default: strain below which a constraint becomes a spring again. A gap
    /// between the two keeps springs from switching in every step.
    std::optional<double> deactivate_at = {};
    bool compression = false;  ///< also springs that are compressed by more than activate_at
    AcadTarget target = AcadTarget::threshold;
    double compliance = 1e-6;  ///< m/N, 1e-9 to 1: of an active constraint
};

/// Duration and time steps.
struct TimeOptions {
    double duration = 5.0;     ///< s, of a run from the command line
    double frame_rate = 60.0;  ///< 1/s, frequency of pictures and statistics
    /// Steps per frame; 0 chooses enough for stability. Steps with limits with memory are divided if they
    /// would be longer than 1/20 s.
    std::uint32_t substeps = 0;
};

/// The camera of pictures, and the colours of the cloth.
enum class ClothColour { checker, strain };
struct Camera {
    Vec3d position{1.6, 1.2, 2.2};  ///< m
    Vec3d target{0, 0.4, 0};        ///< m
    double field_of_view = 35.0;    ///< degrees, vertical
    std::uint32_t width = 1280;     ///< pixels
    std::uint32_t height = 720;     ///< pixels
    ClothColour colour = ClothColour::checker;
};

/// A check of the scene: `value` names a number of the summary, which must be in [min, max] after the whole
/// run.
struct Check {
    std::string value;
    double min = 0, max = 0;
};

/// Refers to a cloth of a scene, and allows further changes. Valid as long as the scene lives.
class PLIANT_API ClothHandle {
public:
    ClothHandle& pin(const Attachment& attachment);
    Cloth* operator->() const { return cloth_; }
    Cloth& operator*() const { return *cloth_; }
    std::size_t index() const { return index_; }

private:
    friend class Scene;
    ClothHandle(Cloth* cloth, std::size_t index) : cloth_(cloth), index_(index) {}
    Cloth* cloth_;
    std::size_t index_;
};

/// The complete input of a simulation.
class PLIANT_API Scene {
public:
    ClothHandle add(Cloth cloth);
    void add(Collider collider);

    std::size_t cloth_count() const { return cloths_.size(); }
    const Cloth& cloth(std::size_t index) const { return *cloths_.at(index); }
    ClothHandle cloth_handle(std::size_t index) { return {cloths_.at(index).get(), index}; }

    std::string name = "scene";
    std::string description;
    Method method = Method::mass_spring;
    Integrator integrator = Integrator::symplectic_euler;  ///< for the method mass_spring
    Solver solver = Solver::newton_multigrid;              ///< for the methods constraint and acad
    NewtonMultigridOptions newton_multigrid;
    PaperOptions paper;
    AcadOptions acad;
    Vec3d gravity{0, -9.81, 0};  ///< m/s2
    Air air;
    TimeOptions time;
    std::vector<Collider> colliders;
    Camera camera;
    std::vector<Check> checks;

    Scene() = default;
    Scene(const Scene& other);
    Scene& operator=(const Scene& other);
    Scene(Scene&&) = default;
    Scene& operator=(Scene&&) = default;
    ~Scene() = default;

private:
    std::vector<std::unique_ptr<Cloth>> cloths_;  // by pointer, so that handles survive further add()s
};

/// Throws Error(bad_input) for the first value out of range; the message names the field as a JSON path.
PLIANT_API void validate(const Scene& scene);

/// Reads a scene file, or a built-in scene by its name. `overrides` are "path=value" as in `--set
/// time.duration=2`. Throws Error(bad_input) naming file, line or JSON path, value, unit and the nearest
/// valid name.
PLIANT_API Scene read_scene(const std::string& file_or_name, const std::vector<std::string>& overrides = {});

/// The name in a scene file.
PLIANT_API const char* name_of(Method method);
PLIANT_API const char* name_of(Integrator integrator);
PLIANT_API const char* name_of(Solver solver);

/// A built-in scene: its name and what it shows.
struct SceneListing {
    std::string name, description;
    std::filesystem::path file;
};
/// The built-in scenes, by name.
PLIANT_API std::vector<SceneListing> list_scenes();

}  // namespace pliant
