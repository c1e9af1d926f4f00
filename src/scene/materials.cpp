// Materials of cloth. Each figure and its source are in docs/scenes.md, "Materials".
#include <array>

#include "pliant/scene.hpp"

namespace pliant {

const MaterialProperties& properties_of(Material material)
{
    static constexpr std::array<MaterialProperties, 7> materials{{
        {},                           // none
        {0.150, 4070, 90, 1.8e-5},    // cotton
        {0.069, 3000, 40, 1.5e-6},    // silk
        {0.324, 2030, 190, 6.42e-5},  // denim
        {0.235, 2500, 60, 1.4e-5},    // wool
        {0.560, 6000, 3000, 2.5e-5},  // leather
        {0.480, 560, 280, 1.8e-5},    // rubber
    }};
    return materials.at(static_cast<std::size_t>(material));
}

Cloth& Cloth::make_of(Material given)
{
    const MaterialProperties& properties = properties_of(given);
    material = given;
    density = properties.density;
    node_mass.reset();
    // The edges of a mesh also provide its shear stiffness, which determines how a cloth drapes: a lattice of
    // equilateral triangles has the shear modulus sqrt(3) / 4 k.
    constexpr double edge_of_shear = 2.309401076758503;  // 4 / sqrt(3)
    const bool sheet = std::holds_alternative<SheetOptions>(shape);
    springs.structural.stiffness = sheet ? properties.stretch : edge_of_shear * properties.shear;
    springs.structural.compliance = 1 / properties.stretch;
    springs.shear.stiffness = properties.shear;
    springs.shear.role = SpringRole::spring;
    springs.bend_model = BendModel::quadratic;
    springs.bending_stiffness = properties.bending;
    return *this;
}

}  // namespace pliant
