// The builders of scene.hpp.
#include "pliant/scene.hpp"

#include <utility>

#include "scene/fields.hpp"

namespace pliant {

const char* name_of(Method method) { return scene_format::method_names.at(static_cast<std::size_t>(method)); }
const char* name_of(Integrator integrator)
{
    return scene_format::integrator_names.at(static_cast<std::size_t>(integrator));
}
const char* name_of(Solver solver) { return scene_format::solver_names.at(static_cast<std::size_t>(solver)); }

Cloth Cloth::sheet(const SheetOptions& options)
{
    Cloth cloth;
    SheetOptions shape = options;
    cloth.density = std::exchange(shape.density, {});  // from here on only the cloth's own density is used
    cloth.node_mass = std::exchange(shape.node_mass, {});
    cloth.shape = shape;
    return cloth;
}

Cloth Cloth::mesh(SurfaceMesh mesh, const MeshOptions& options)
{
    Cloth cloth;
    cloth.shape = std::move(mesh);
    cloth.density = options.density;
    cloth.node_mass = options.node_mass;
    cloth.scale = options.scale;
    return cloth;
}

Cloth Cloth::disc(const DiscOptions& options)
{
    Cloth cloth;
    DiscOptions shape = options;
    cloth.density = std::exchange(shape.density, {});
    cloth.node_mass = std::exchange(shape.node_mass, {});
    cloth.shape = shape;
    return cloth;
}

Cloth Cloth::soft_body(SurfaceMesh surface, const BodyOptions& body, const MeshOptions& options)
{
    Cloth cloth = mesh(std::move(surface), options);
    cloth.name = "body";
    cloth.body = body;
    return cloth;
}

ClothHandle& ClothHandle::pin(const Attachment& attachment)
{
    cloth_->pin(attachment);
    return *this;
}

ClothHandle Scene::add(Cloth cloth)
{
    cloths_.push_back(std::make_unique<Cloth>(std::move(cloth)));
    return cloth_handle(cloths_.size() - 1);
}

void Scene::add(Collider collider) { colliders.push_back(std::move(collider)); }

Scene::Scene(const Scene& other)
    : name(other.name),
      description(other.description),
      method(other.method),
      integrator(other.integrator),
      solver(other.solver),
      newton_multigrid(other.newton_multigrid),
      paper(other.paper),
      acad(other.acad),
      gravity(other.gravity),
      air(other.air),
      time(other.time),
      colliders(other.colliders),
      camera(other.camera),
      checks(other.checks)
{
    cloths_.reserve(other.cloths_.size());
    for (const auto& cloth : other.cloths_) cloths_.push_back(std::make_unique<Cloth>(*cloth));
}

Scene& Scene::operator=(const Scene& other) { return *this = Scene(other); }

}  // namespace pliant
