#pragma once
#include <cmath>

#include "engine/exchange/export_scene.h"
#include "tests/unit/exchange/sample_surface.h"

namespace spia::samples {

/// A curved sheet with a square hole, its blank and smooth fields: what the chain hands to the
/// writers.
struct Chain {
    TriMesh part;
    Blank blank;
    SheetFields node, face;
    QuadGrid quads;
    TriMesh surface;
    NurbsSurface net;

    ExportScene scene() const { return {"left door", &part, &blank, &node, &quads, &surface, nullptr, {&net, 1}}; }
};

inline SheetFields smooth_fields(int count)
{
    SheetFields f;
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(count, 0, 3);
    f.thinning = 0.1 * x.array().sin() - 0.02;
    f.thickness = 0.8 * (1 - f.thinning.array());
    f.strain_major = 0.2 * x.array().cos().square();
    f.strain_minor = -0.1 * x.array() / 3;
    f.strain_equivalent = 0.25 * x.array().cos().square() + 1e-17;
    f.stress_major = 300 + 50 * x.array();
    f.stress_minor = 100 - 50 * x.array();
    f.stress_equivalent = 320 + 7 * x.array();
    f.direction_major = Eigen::Vector3d(0.6, 0.8, 0).replicate(1, count);
    f.necking = Eigen::VectorXi::LinSpaced(count, 0, count - 1).unaryExpr([](int i) { return int(i % 3 == 0); });
    return f;
}

/// @param cells along x; a multiple of 4. The hole leaves vertices without faces, as real meshes
/// may have them.
inline Chain chain(int cells = 12, double size = 400)
{
    Chain c;
    const int rows = cells * 3 / 4, n = cells + 1;
    const auto lifted = [&](double x, double y) {
        return Eigen::Vector3d(2000 + x, y, 700 + 0.15 * size * std::sin(3 * x / size) * std::cos(4 * y / size));
    };
    c.part.position.resize(3, n * (rows + 1));
    c.blank.position.resize(2, n * (rows + 1));
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = size * i / cells, y = size * j / cells;
            c.part.position.col(i + j * n) = lifted(x, y);
            c.blank.position.col(i + j * n) << 1.07 * x + 1 / 3.0, 1.04 * y - 50;
        }
    std::vector<Eigen::Vector3i> faces;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < cells; ++i) {
            if (3 * i >= cells && 3 * i < 2 * cells && 3 * j >= rows && 3 * j < 2 * rows)
                continue;
            const int a = i + j * n;
            faces.emplace_back(a, a + 1, a + 1 + n);
            faces.emplace_back(a, a + 1 + n, a + n);
        }
    c.part.triangle.resize(3, int(faces.size()));
    for (size_t f = 0; f < faces.size(); ++f)
        c.part.triangle.col(int(f)) = faces[f];
    c.node = smooth_fields(c.part.vertices());
    c.face = smooth_fields(c.part.triangles());

    c.quads.columns = 8;
    c.quads.rows = 6;
    c.quads.position.resize(3, c.quads.nodes());
    for (int j = 0; j <= 6; ++j)
        for (int i = 0; i <= 8; ++i)
            c.quads.position.col(c.quads.node(i, j)) = lifted(size * i / 8, size * 0.75 * j / 6);
    c.surface = triangles_of(c.quads);
    c.net = curved_surface(size, false, 9, 7);
    for (int j = 0; j <= 6; ++j)
        for (int i = 0; i <= 8; ++i)
            c.net.control.col(c.net.index(i, j)) = c.quads.position.col(c.quads.node(i, j)) + Eigen::Vector3d(0, 0, 5);
    return c;
}

} // namespace spia::samples
