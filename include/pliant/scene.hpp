// What is simulated: cloths, colliders, air and gravity. SI units everywhere; y is up.
//
// A Scene is plain data plus the few builders that make it pleasant to write by hand. `read_scene` fills the
// same structure from a scene file (docs/scenes.md), and `validate` is the one place that says what is
// allowed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pliant/error.hpp"
#include "pliant/mesh.hpp"
#include "pliant/vec3.hpp"

namespace pliant {

/// Corners of a sheet: "top" is row 0, "left" is column 0.
enum class Corner { top_left, top_right, bottom_left, bottom_right };
/// Edges of a sheet: "top" is row 0, "left" is column 0.
enum class Edge { top, bottom, left, right };
/// An axis-aligned region of the scene; a node that is inside or on the border of it before the first step is
/// meant.
struct Region {
    Vec3d min, max;  ///< m
};
/// What to hold in place: a node index (unsigned, row by row on a sheet), a named corner or edge of a sheet,
/// or every node in a region.
using Pin = std::variant<std::uint32_t, Corner, Edge, Region>;

/// Stiffness and damping of one class of spring.
struct SpringParameters {
    double stiffness = 0;  ///< N/m, 0 to 1e9; 0 together with damping 0: no force
    double damping = 0;    ///< N s/m, 0 to 1e6
};

/// The three classes of the cloth paper (section 2.1). On a triangle mesh an edge is structural, and a bend
/// spring joins the two vertices opposite an interior edge; there are no shear springs.
struct Springs {
    SpringParameters structural{1000.0, 0.01};
    SpringParameters shear{500.0,
                           0.01};  ///< half the structural stiffness makes a sheet isotropic (nu = 1/3)
    SpringParameters bend{10.0, 0.001};
};

/// How spring forces are computed; both give the same bits.
enum class Formulation {
    automatic,     ///< node-centric on sheets, spring list on meshes
    node_centric,  ///< each node gathers its (at most 12) springs; sheets only
    spring_list,   ///< the papers' edge-centric form: one force per spring, gathered per node without atomics
};

/// A rectangular sheet of `rows` x `columns` nodes, flat and at rest, lying in the x-z plane.
struct SheetOptions {
    std::uint32_t rows = 2;                ///< nodes, >= 2; row 0 is the "top", at the side of negative z
    std::uint32_t columns = 2;             ///< nodes, >= 2; column 0 is the "left", at the side of negative x
    double width = 1.0;                    ///< m, along a row (x before rotation)
    double height = 1.0;                   ///< m, along a column (z before rotation)
    std::optional<double> density = {};    ///< kg/m2; 0.3 when neither this nor node_mass is given
    std::optional<double> node_mass = {};  ///< kg per node, instead of density
};

/// A cloth of any shape.
struct MeshOptions {
    std::optional<double> density = {};    ///< kg/m2; 0.3 when neither this nor node_mass is given
    std::optional<double> node_mass = {};  ///< kg per node, instead of density
    double scale = 1.0;                    ///< multiplies the coordinates of the mesh
};

/// One piece of cloth: its shape at rest, its material, what holds it.
struct Cloth {
    static Cloth sheet(const SheetOptions& options);
    static Cloth mesh(SurfaceMesh mesh, const MeshOptions& options = {});

    Cloth& pin(const Pin& where)
    {
        pins.push_back(where);
        return *this;
    }

    std::string name = "cloth";
    std::variant<SheetOptions, SurfaceMesh> shape;
    /// kg/m2; a sheet shares its mass equally, a mesh by the area around a vertex. 0.3 when neither this nor
    /// node_mass is set. The one of SheetOptions is moved here by `sheet`; in `shape` itself it must stay
    /// empty.
    std::optional<double> density;
    std::optional<double> node_mass;  ///< kg per node, instead of density
    double scale = 1.0;               ///< of a mesh
    Vec3d position;                   ///< m, where the origin of the shape (the centre of a sheet) is put
    Vec3d rotation;                   ///< degrees about x, then y, then z
    Vec3d velocity;                   ///< m/s, of every node at the start
    Springs springs;
    Formulation formulation = Formulation::automatic;
    double damping = 0.1;      ///< 1/s; every velocity loses this fraction a second
    double thickness = 0.002;  ///< m; the distance that contact keeps between a node and a collider
    std::vector<Pin> pins;
};

/// What a collider does with a node that enters it.
enum class ContactResponse {
    coulomb,  ///< remove the approaching normal velocity, Coulomb friction, keep the rest
    paper,    ///< Algorithm 4 of the cloth paper as printed (its velocity has no units; see docs/physics.md)
};

/// Where a moving collider is at a time; in between, positions and angles are interpolated linearly.
struct Keyframe {
    double time = 0;      ///< s, increasing
    Vec3d position = {};  ///< m, added to the collider's own
    Vec3d rotation = {};  ///< degrees about x, then y, then z, around the collider's centre
};

// friction: Coulomb coefficient, 0 to 10. keyframes: empty, and it stands still.
// The shapes are written so that designated initialisers read well: {.centre = {0, 0.4, 0}, .radius = 0.3,
// .friction = 0.4}
struct Sphere {
    Vec3d centre = {};    ///< m
    double radius = 0.5;  ///< m
    double friction = 0.3;
    ContactResponse response = ContactResponse::coulomb;
    std::vector<Keyframe> keyframes = {};
};
/// Everything behind the plane (against its normal) is solid.
struct Plane {
    Vec3d point = {};          ///< m
    Vec3d normal = {0, 1, 0};  ///< need not be of length 1
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
using Collider = std::variant<Sphere, Plane, Box, Capsule>;

/// Moving air; forces per triangle by its velocity against the air. Off while `density` is 0.
struct Air {
    Vec3d velocity = {};  ///< m/s, the wind
    double density = 0;   ///< kg/m3; 1.2 for air
    double drag = 1.0;    ///< coefficient, along the relative wind
    double lift = 0.5;    ///< coefficient, across it
};

/// Length and resolution of time.
struct TimeOptions {
    double duration = 5.0;       ///< s, of a run from the command line
    double frame_rate = 60.0;    ///< 1/s, pictures and statistics per second
    std::uint32_t substeps = 0;  ///< steps per frame; 0 chooses enough for stability
};

/// Where pictures are taken from, and how the cloth is coloured.
enum class ClothColour { checker, strain };
struct Camera {
    Vec3d position{1.6, 1.2, 2.2};  ///< m
    Vec3d target{0, 0.4, 0};        ///< m
    double field_of_view = 35.0;    ///< degrees, vertical
    std::uint32_t width = 1280;     ///< pixels
    std::uint32_t height = 720;     ///< pixels
    ClothColour colour = ClothColour::checker;
};

/// A scene's own check: `value` names a number of the summary, which must lie in [min, max] after the whole
/// run.
struct Check {
    std::string value;
    double min = 0, max = 0;
};

/// Names a cloth of a scene, and lets it be changed further. Valid as long as the scene lives.
class ClothHandle {
public:
    ClothHandle& pin(const Pin& where);
    Cloth* operator->() const { return cloth_; }
    Cloth& operator*() const { return *cloth_; }
    std::size_t index() const { return index_; }

private:
    friend class Scene;
    ClothHandle(Cloth* cloth, std::size_t index) : cloth_(cloth), index_(index) {}
    Cloth* cloth_;
    std::size_t index_;
};

/// Everything a simulation starts from.
class Scene {
public:
    ClothHandle add(Cloth cloth);
    void add(Collider collider);

    std::size_t cloth_count() const { return cloths_.size(); }
    const Cloth& cloth(std::size_t index) const { return *cloths_.at(index); }
    ClothHandle cloth_handle(std::size_t index) { return {cloths_.at(index).get(), index}; }

    std::string name = "scene";
    std::string description;
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

/// Throws Error(bad_input) for the first value that is out of its range; the message names the field as a
/// JSON path.
void validate(const Scene& scene);

/// Reads a scene file, or a built-in scene by its name. `overrides` are "path=value" as in `--set
/// time.duration=2`. Throws Error(bad_input) naming file, line or JSON path, value, unit and the nearest
/// valid name.
Scene read_scene(const std::string& file_or_name, const std::vector<std::string>& overrides = {});

/// A built-in scene: its name and what it shows.
struct SceneListing {
    std::string name, description;
    std::filesystem::path file;
};
/// The built-in scenes, by name.
std::vector<SceneListing> list_scenes();

}  // namespace pliant
