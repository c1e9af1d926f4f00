#include "serial_scene.hpp"

#include <algorithm>
#include <cmath>

#include "body/cloth_model.hpp"

namespace pliant::serial {
namespace {

Vector vector_of(Vec3d a)
{
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

[[noreturn]] void refuse(const Scene& scene, const std::string& what)
{
    throw Error(ErrorKind::bad_input,
                "scene '" + scene.name + "' has " + what +
                    ", which the serial baseline does not know; leave it out to compare with it");
}

void require_known(const Scene& scene, Method method)
{
    if (scene.cloth_count() != 1) refuse(scene, std::to_string(scene.cloth_count()) + " cloths");
    if (scene.method != method) refuse(scene, std::string("the method ") + name_of(scene.method));
    if (scene.air.density > 0) refuse(scene, "moving air");
    for (const Attachment& pin : scene.cloth(0).pins)
        if (!pin.keyframes.empty()) refuse(scene, "a moving pin");
    if (!scene.cloth(0).body) return;
    const BodyOptions& body = *scene.cloth(0).body;
    if (!body.forces.empty()) refuse(scene, "forces on a region");
    if (!body.volume.target.empty() || !body.volume.pressure.empty())
        refuse(scene, "a volume or a pressure that is asked for");
    if (body.volume.focus || !body.volume.weights.empty()) refuse(scene, "weights of the volume constraint");
}

void add_colliders(const Scene& scene, Cloth& cloth)
{
    const double thickness = scene.cloth(0).thickness;
    for (const Collider& collider : scene.colliders) {
        const auto* sphere = std::get_if<pliant::Sphere>(&collider);
        const auto* plane = std::get_if<pliant::Plane>(&collider);
        if (!sphere && !plane) refuse(scene, "a box or a capsule");
        if (sphere ? !sphere->keyframes.empty() : !plane->keyframes.empty())
            refuse(scene, "a moving collider");
        if ((sphere ? sphere->response : plane->response) != ContactResponse::coulomb)
            refuse(scene, "contact as the paper prints it");
        if (sphere)
            cloth.spheres.push_back({vector_of(sphere->centre),
                                     static_cast<float>(sphere->radius + thickness),
                                     static_cast<float>(sphere->friction)});
        else
            cloth.planes.push_back(
                {vector_of(plane->point),
                 vector_of(plane->normal * (1 / std::sqrt(dot(plane->normal, plane->normal)))),
                 static_cast<float>(thickness), static_cast<float>(plane->friction)});
    }
}

/// The vertex of each node; Pliant may number them otherwise than their mesh.
std::vector<std::uint32_t> vertices_of_nodes(const ClothModel& model)
{
    std::vector<std::uint32_t> vertices(model.node_count());
    for (std::uint32_t k = 0; k < model.node_count(); ++k)
        vertices[model.shape.node_of_vertex.empty() ? k : model.shape.node_of_vertex[k]] = k;
    return vertices;
}

Spring spring_of(const ClothModel& model, std::uint32_t i, std::uint32_t j, SpringClass spring_class,
                 double rest_length)
{
    const auto k = static_cast<std::size_t>(spring_class);
    return {std::min(i, j), std::max(i, j), static_cast<float>(rest_length),
            static_cast<float>(model.parameters.stiffness[k]),
            static_cast<float>(model.parameters.spring_damping[k])};
}

Cloth cloth_of(const ClothModel& model, const Scene& scene, const std::vector<std::uint32_t>& vertices)
{
    Cloth cloth;
    cloth.gravity = vector_of(scene.gravity);
    cloth.damping = static_cast<float>(scene.cloth(0).damping);
    add_colliders(scene, cloth);
    cloth.nodes.resize(model.node_count());
    for (std::uint32_t k = 0; k < model.node_count(); ++k) {
        const Vec3 v = model.shape.velocities[k];
        cloth.nodes[vertices[k]] = {vector_of(to_double(model.shape.positions[k]) + model.shape.origin),
                                    {v.x, v.y, v.z},
                                    {},
                                    static_cast<float>(model.masses.inverse(k))};
    }
    cloth.springs.reserve(model.springs.count);
    if (model.plan.node_centric) {
        for_each_sheet_spring(
            *model.shape.sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& neighbour) {
                cloth.springs.push_back(
                    spring_of(model, i, j, neighbour.spring_class,
                              model.shape.sheet->rest_lengths[static_cast<std::size_t>(neighbour.rest)]));
            });
    } else {
        for (const pliant::Spring& spring : model.springs.list)
            cloth.springs.push_back(spring_of(model, vertices[spring.i], vertices[spring.j],
                                              spring.spring_class, spring.rest_length));
        std::sort(cloth.springs.begin(), cloth.springs.end(),
                  [](const Spring& a, const Spring& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    }
    return cloth;
}

}  // namespace

Cloth cloth_of(const Scene& scene)
{
    require_known(scene, Method::mass_spring);
    const ClothModel model(scene.cloth(0), scene);
    return cloth_of(model, scene, vertices_of_nodes(model));
}

Body body_of(const Scene& scene)
{
    require_known(scene, Method::volume);
    const ClothModel model(scene.cloth(0), scene);
    if (!model.body) refuse(scene, "no soft body");
    const std::vector<std::uint32_t> vertices = vertices_of_nodes(model);
    Body body;
    body.skin = cloth_of(model, scene, vertices);
    for (const Triangle& t : model.shape.triangles())
        body.triangles.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
    body.wanted_volume = volume_of(body);
    return body;
}

}  // namespace pliant::serial
