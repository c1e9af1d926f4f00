// What the solver's passes left in their arena, as dense vectors and matrices: by vertex of the cloth.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "backend/host/solver_kernels.hpp"
#include "backend/pass_runner.hpp"
#include "body/cloth_model.hpp"
#include "kernels/planes.hpp"
#include "oracle/implicit_step.hpp"

namespace pliant::oracle {

class SolverArena {
public:
    /// `on_host`: there the planes of the operator lie together, see SolverKernels::at.
    SolverArena(const ClothModel& model, PassRunner& runner, bool on_host)
        : model_(model), level_(model.hierarchy.levels.front()), on_host_(on_host)
    {
        runner.solver_numbers(0, 0, model.hierarchy.number_count, numbers_);
    }

    /// A vector of three planes.
    Vector vector(int plane) const
    {
        Vector all(static_cast<Eigen::Index>(3 * model_.node_count()));
        Eigen::Index row = 0;
        for (std::uint32_t vertex = 0; vertex < model_.node_count(); ++vertex)
            for (int k = 0; k < 3; ++k) all[row++] = at(plane + k, model_.shape.node(vertex));
        return all;
    }

    /// The diagonal blocks, of what they are factored to: the inverse pivots, and L below them.
    std::vector<Block> diagonal() const
    {
        std::vector<Block> all;
        for (std::uint32_t vertex = 0; vertex < model_.node_count(); ++vertex) {
            const Block f = six(plane_factor, model_.shape.node(vertex));
            Block lower = Block::Identity(), pivots = Block::Zero();
            lower(1, 0) = f(0, 1), lower(2, 0) = f(0, 2), lower(2, 1) = f(1, 2);
            for (int k = 0; k < 3; ++k) pivots(k, k) = f(k, k) > 0 ? 1 / f(k, k) : 0;
            all.push_back(lower * pivots * lower.transpose());
        }
        return all;
    }

    /// The operator, of its row sums and couplings. `coarse`: with the couplings that coarser levels are made
    /// of.
    Matrix matrix(bool coarse = false) const
    {
        const auto n = static_cast<Eigen::Index>(3 * model_.node_count());
        Matrix a = Matrix::Zero(n, n);
        if (model_.plan.on_grid)
            add_sheet(a, coarse);
        else
            add_mesh(a);
        return a;
    }

private:
    /// Where a number of a plane lies, of a node.
    double at(int plane, std::uint32_t node) const
    {
        const int rows = level_.rows > 1 ? level_.columns : static_cast<int>(model_.node_count());
        return at(plane,
                  Hierarchy::offset(level_, static_cast<int>(node) / rows, static_cast<int>(node) % rows));
    }
    double at(int plane, std::int32_t offset) const
    {
        int place = level_.base + plane * level_.size + offset;
        using Kernels = SolverKernels<double>;
        if (on_host_ && Kernels::is_of_operator(plane)) {
            // On a mesh nothing lies before the first offset of its one row.
            const int first = level_.edge_size > 0
                                  ? Hierarchy::offset(level_, 0, 0) - static_cast<int>(NodeLayout::pad)
                                  : 0;
            place = level_.base + plane_block * level_.size + first - Kernels::in_groups(plane_block, first) +
                    Kernels::in_groups(plane, offset);
        }
        return double{numbers_.at(static_cast<std::size_t>(place))};
    }
    Block six(int plane, std::uint32_t node) const
    {
        return symmetric([&](int k) { return at(plane + k, node); });
    }
    template <class Number>
    static Block symmetric(const Number& number)
    {
        Block b;
        b << number(0), number(1), number(2), number(1), number(3), number(4), number(2), number(4),
            number(5);
        return b;
    }
    bool is_free(std::uint32_t node) const { return model_.masses.inverse(node) > 0; }

    /// B (x_i - x_j) at node i, and its negative at node j; where the other is pinned nothing is left of it.
    void add_coupling(Matrix& a, std::uint32_t i, std::uint32_t j, const Block& b) const
    {
        if (is_free(i)) a.block<3, 3>(3 * i, 3 * i) += b;
        if (is_free(j)) a.block<3, 3>(3 * j, 3 * j) += b;
        if (!is_free(i) || !is_free(j)) return;
        a.block<3, 3>(3 * i, 3 * j) -= b;
        a.block<3, 3>(3 * j, 3 * i) -= b;
    }

    void add_sheet(Matrix& a, bool coarse) const
    {
        struct Forward {
            int row, column, plane;
        };
        const bool bent = model_.limits.bends_by_constraints();
        std::vector<Forward> forward{{0, 1, bent && coarse ? plane_fold : plane_block},
                                     {1, -1, plane_block + 6},
                                     {1, 0, bent && coarse ? plane_fold + 6 : plane_block + 12},
                                     {1, 1, plane_block + 18}};
        if (bent && !coarse) forward.insert(forward.end(), {{0, 2, plane_bend}, {2, 0, plane_bend + 6}});
        for (int row = 0; row < level_.rows; ++row)
            for (int column = 0; column < level_.columns; ++column) {
                const auto i = static_cast<std::uint32_t>(row * level_.columns + column);
                a.block<3, 3>(3 * i, 3 * i) += six(plane_row_sum, i);
                for (const Forward& f : forward) {
                    const int r = row + f.row, c = column + f.column;
                    if (r >= level_.rows || c < 0 || c >= level_.columns) {
                        EXPECT_EQ(six(f.plane, i).norm(), 0) << "a coupling beyond the border";
                        continue;
                    }
                    add_coupling(a, i, static_cast<std::uint32_t>(r * level_.columns + c), six(f.plane, i));
                }
            }
    }

    void add_mesh(Matrix& a) const
    {
        const auto topology = [&](std::int32_t k) {
            return model_.hierarchy.topology[static_cast<std::size_t>(k)];
        };
        const auto block_at = [&](std::int32_t e) {
            return symmetric([&](int k) {
                return double{numbers_[static_cast<std::size_t>(level_.edge_base +
                                                                edge_block * level_.edge_size + 6 * e + k)]};
            });
        };
        std::vector<std::uint32_t> vertex_of(model_.node_count());
        for (std::uint32_t v = 0; v < model_.node_count(); ++v) vertex_of[model_.shape.node(v)] = v;
        const std::int32_t first = Hierarchy::offset(level_, 0, 0);
        for (std::uint32_t node = 0; node < model_.node_count(); ++node) {
            const std::uint32_t v = vertex_of[node];
            a.block<3, 3>(3 * v, 3 * v) += block_at(level_.edges + static_cast<std::int32_t>(node));
        }
        // Loose springs are folded onto others.
        for (std::int32_t e = 0; e < level_.loose; ++e) {
            const auto i = static_cast<std::uint32_t>(topology(level_.edge_ends + 3 * e) - first);
            const auto j = static_cast<std::uint32_t>(topology(level_.edge_ends + 3 * e + 1) - first);
            // What leads to a pinned node is in the row sum of the other one.
            if (!is_free(i) || !is_free(j)) continue;
            const Block b = block_at(e);
            const std::uint32_t v = vertex_of[i], w = vertex_of[j];
            a.block<3, 3>(3 * v, 3 * v) += b;
            a.block<3, 3>(3 * w, 3 * w) += b;
            a.block<3, 3>(3 * v, 3 * w) -= b;
            a.block<3, 3>(3 * w, 3 * v) -= b;
        }
    }

    const ClothModel& model_;
    SolverLevel level_;
    bool on_host_;
    std::vector<float> numbers_;
};

}  // namespace pliant::oracle
