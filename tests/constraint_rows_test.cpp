// Which springs the solver paper takes for constraints, and how a model starts.
#include <gtest/gtest.h>

#include "body/cloth_model.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

TEST(ConstraintRows, LeaveOutWhatTwoPinsHold)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.solver = Solver::paper;
    Cloth cloth = test::flat_sheet(4, 5);
    cloth.pin(Edge::top);
    scene.add(cloth);
    const ClothModel model(scene.cloth(0), scene);
    std::size_t held = 0, free = 0;
    for (const Spring& spring : model.springs)
        if (spring.spring_class != SpringClass::bend)
            ++(model.inverse_mass(spring.i) > 0 || model.inverse_mass(spring.j) > 0 ? free : held);
    EXPECT_EQ(held, 4u);  // along the edge
    EXPECT_EQ(model.hierarchy.constraints.constraints, free);
    EXPECT_EQ(model.hierarchy.constraints.springs, model.springs.size());
}

TEST(Pins, OfAClothThatIsThrownStandStill)
{
    for (const bool mesh : {false, true}) {
        Scene scene;
        Cloth cloth =
            mesh ? Cloth::mesh(test::irregular_mesh(4, 5), {.density = 0.3}) : test::flat_sheet(4, 5);
        cloth.velocity = {1, 2, 3};
        cloth.pin(std::uint32_t{7});
        scene.add(cloth);
        const ClothModel model(scene.cloth(0), scene);
        for (std::uint32_t vertex = 0; vertex < 20; ++vertex)
            EXPECT_EQ(model.velocities[model.node(vertex)], vertex == 7 ? Vec3{} : (Vec3{1, 2, 3})) << vertex;
    }
}

}  // namespace
}  // namespace pliant
