// Packs to records and back, at every width a kernel may have, of which this machine runs but some.
#include <gtest/gtest.h>

#include <vector>

#include "backend/cpu/records.hpp"

namespace pliant {
namespace {

template <int W>
void expect_records_and_packs_agree()
{
    constexpr std::uint32_t stride = 8, count = 40;
    std::vector<float> records(count * stride + 4);
    for (std::size_t k = 0; k < records.size(); ++k) records[k] = static_cast<float>(k);
    std::uint32_t place[W];
    for (std::uint32_t lane = 0; lane < W; ++lane) place[lane] = (7 * lane + 3) % count * stride;

    const auto quad_at = [&](int lane) {
        Quad quad;
        for (std::uint32_t k = 0; k < 4; ++k) quad[k] = records[place[lane] + k];
        return quad;
    };
    const Vector3<Pack<W>> gathered = vectors_from_quads<W>(quad_at);
    for (int lane = 0; lane < W; ++lane) {
        EXPECT_EQ(gathered.x.lanes[lane], records[place[lane]]) << W << " lanes, lane " << lane;
        EXPECT_EQ(gathered.y.lanes[lane], records[place[lane] + 1]) << W << " lanes, lane " << lane;
        EXPECT_EQ(gathered.z.lanes[lane], records[place[lane] + 2]) << W << " lanes, lane " << lane;
    }

    std::vector<int> seen(W, 0);
    quads_from_vectors<W>(gathered, [&](int lane, const Quad& quad) {
        ++seen[static_cast<std::size_t>(lane)];
        for (std::uint32_t k = 0; k < 3; ++k)
            EXPECT_EQ(quad[k], records[place[lane] + k]) << W << " lanes, lane " << lane;
        EXPECT_EQ(quad[3], 0.0f);
    });
    EXPECT_EQ(seen, std::vector<int>(W, 1));
}

TEST(Records, ArePacksWithTheirNumbersSideBySide)
{
    expect_records_and_packs_agree<4>();
    expect_records_and_packs_agree<8>();
    expect_records_and_packs_agree<16>();
}

}  // namespace
}  // namespace pliant
