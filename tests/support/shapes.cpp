#include "tests/support/shapes.h"

namespace spia::shapes {

TriMesh rectangle(double width, double height, int columns, int rows)
{
    TriMesh mesh;
    mesh.position.resize(3, (columns + 1) * (rows + 1));
    mesh.triangle.resize(3, 2 * columns * rows);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            mesh.position.col(i + j * (columns + 1)) << width * i / columns, height * j / rows, 0;
    int f = 0;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = i + j * (columns + 1), b = a + 1, c = b + columns + 1, d = c - 1;
            mesh.triangle.col(f++) << a, b, c;
            mesh.triangle.col(f++) << a, c, d;
        }
    return mesh;
}

} // namespace spia::shapes
