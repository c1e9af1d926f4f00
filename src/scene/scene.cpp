// The builders of scene.hpp.
#include "pliant/scene.hpp"

#include <utility>

namespace pliant {

Cloth Cloth::sheet(const SheetOptions& options)
{
    Cloth cloth;
    SheetOptions shape = options;
    cloth.density = std::exchange(shape.density, {});  // from here on the cloth's own is the only one
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

ClothHandle& ClothHandle::pin(const Pin& where)
{
    cloth_->pin(where);
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
