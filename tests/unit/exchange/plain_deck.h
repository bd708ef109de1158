#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/exchange/deck/deck.h"

namespace spia::sample {

/// Nodes and shells by their ids, as a deck without any keyword that makes or moves them would list
/// them.
struct PlainDeck {
    std::map<std::int64_t, Eigen::Vector3d> node;
    std::map<std::int64_t, std::vector<std::int64_t>> shell;

    PlainDeck() = default;
    /// @pre no id is given twice
    explicit PlainDeck(const Deck& deck)
    {
        for (int v = 0; v < deck.nodes(); ++v)
            EXPECT_TRUE(node.emplace(deck.node[size_t(v)], deck.position[size_t(v)]).second) << deck.node[size_t(v)];
        for (int e = 0; e < deck.elements(); ++e) {
            std::vector<std::int64_t>& corners = shell[deck.element[size_t(e)]];
            for (const int corner : deck.corner[size_t(e)])
                if (corner >= 0)
                    corners.push_back(deck.node[size_t(corner)]);
        }
    }

    std::string abaqus() const
    {
        std::string text = "*NODE\n";
        for (const auto& [id, x] : node)
            text += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", id, x.x(), x.y(), x.z());
        for (const auto& [id, corners] : shell) {
            text += fmt::format("*ELEMENT,TYPE=S{}\n{}", corners.size(), id);
            for (const std::int64_t corner : corners)
                text += fmt::format(",{}", corner);
            text += "\n";
        }
        return text;
    }
};

/// The same ids, the same corners in the same order, and the same places within a part of 1e9 of
/// the largest coordinate.
inline void expect_same(const PlainDeck& made, const PlainDeck& plain)
{
    EXPECT_EQ(made.shell, plain.shell);
    ASSERT_EQ(made.node.size(), plain.node.size());
    for (const auto& [id, x] : plain.node) {
        const auto found = made.node.find(id);
        ASSERT_TRUE(found != made.node.end()) << id;
        EXPECT_LT((found->second - x).norm(), 1e-9 * (1 + x.norm()))
            << id << ": " << found->second.transpose() << " is not " << x.transpose();
    }
}

struct Chance {
    std::mt19937 engine;
    explicit Chance(unsigned seed) : engine(seed) {}
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }
    double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    Eigen::Vector3d vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
};

/// By the formula of Rodrigues.
inline Eigen::Vector3d turned(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                              double degrees)
{
    const Eigen::Vector3d k = (to - from).normalized(), v = x - from;
    const double angle = degrees * std::numbers::pi / 180;
    return from + v * std::cos(angle) + k.cross(v) * std::sin(angle) + k * k.dot(v) * (1 - std::cos(angle));
}

/// A grid of columns x rows quads whose nodes and elements are numbered on from these, row after
/// row.
inline PlainDeck grid(int columns, int rows, std::int64_t first_node, std::int64_t row_step, std::int64_t first_shell,
                      const std::function<Eigen::Vector3d(int, int)>& place)
{
    PlainDeck deck;
    const auto id = [&](int i, int j) { return first_node + i + row_step * j; };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            deck.node[id(i, j)] = place(i, j);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            deck.shell[first_shell + i + std::int64_t(columns) * j] = {id(i, j), id(i + 1, j), id(i + 1, j + 1),
                                                                       id(i, j + 1)};
    return deck;
}

} // namespace spia::sample
