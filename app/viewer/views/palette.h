#pragma once
#include <array>

#include "app/viewer/model/document/scene.h"

/// The colours of what is drawn on and around the sheet. Those of the sheet itself are in scene.h
/// and colours.h.
namespace spia::viewer::palette {

inline constexpr Colour casing{0.04f, 0.05f, 0.07f, 0.85f}; ///< around light lines
inline constexpr Colour selected{0.93f, 0.10f, 0.62f, 1};   ///< magenta: in none of the colour maps
inline constexpr Colour extreme{0.98f, 0.98f, 0.98f, 1};
inline constexpr Colour probe{0.93f, 0.75f, 0.16f, 1};
inline constexpr Colour stretched{0.80f, 0.16f, 0.10f, 1}; ///< principal strains, positive
inline constexpr Colour squeezed{0.07f, 0.27f, 0.72f, 1};  ///< negative
inline constexpr Colour corner{0.98f, 0.98f, 0.98f, 1};
inline constexpr Colour drawbead{0.98f, 0.55f, 0.12f, 1};
inline constexpr Colour pilot{0.20f, 0.80f, 0.88f, 1};
inline constexpr Colour bend{0.04f, 0.05f, 0.07f, 1}, bend_ground{1, 1, 1, 0.8f}; ///< lines of bends on the blank
inline constexpr Colour folded{0.90f, 0.12f, 0.16f, 1};
inline constexpr Colour fixed{0.97f, 0.78f, 0.10f, 1};  ///< faces that carry what a step moves
inline constexpr Colour freed{0.20f, 0.72f, 0.32f, 1};  ///< faces that a step moves
inline constexpr Colour chosen{0.26f, 0.55f, 0.96f, 1}; ///< what is read of a file
/// the face in space onto which it moves them
inline constexpr Colour target{0.30f, 0.58f, 0.95f, 0.28f};
inline constexpr Colour reference{0.90f, 0.62f, 0.00f, 1}; ///< the outline of an earlier blank:
                                                           ///< orange, away from the fields' blue
inline constexpr Colour quads{0.80f, 0.83f, 0.86f, 1};
inline constexpr Colour surface{0.60f, 0.72f, 0.84f, 1};
/// Of patches: neighbours have different ones.
inline constexpr std::array<Colour, 6> patches{Colour{0.55f, 0.69f, 0.84f, 1}, Colour{0.93f, 0.74f, 0.51f, 1},
                                               Colour{0.60f, 0.80f, 0.61f, 1}, Colour{0.84f, 0.61f, 0.66f, 1},
                                               Colour{0.74f, 0.68f, 0.86f, 1}, Colour{0.90f, 0.86f, 0.55f, 1}};
inline constexpr Colour ghost{0.62f, 0.66f, 0.72f, 0.22f};

constexpr Colour text(bool dark) { return dark ? Colour{0.93f, 0.94f, 0.96f, 1} : Colour{0.10f, 0.12f, 0.15f, 1}; }
/// Lines of what is measured: against the ground of the theme, with a casing against the colours of
/// the sheet.
constexpr Colour measure(bool dark) { return dark ? Colour{0.98f, 0.98f, 0.98f, 1} : Colour{0.04f, 0.05f, 0.07f, 1}; }
constexpr Colour measure_casing(bool dark) { return dark ? casing : Colour{1, 1, 1, 0.9f}; }
constexpr Colour outline(bool dark) { return dark ? Colour{0.88f, 0.90f, 0.93f, 1} : Colour{0.10f, 0.12f, 0.15f, 1}; }
constexpr Colour net(bool dark)
{
    return dark ? Colour{0.99f, 0.86f, 0.50f, 0.55f} : Colour{0.45f, 0.17f, 0.03f, 0.45f};
}
constexpr Colour lattice(bool dark) { return dark ? Colour{0.45f, 0.86f, 0.78f, 1} : Colour{0.02f, 0.42f, 0.38f, 1}; }

/// Of the sides v = 0, u = 1, v = 1, u = 0: equally light, a quarter of the colour circle apart.
std::array<Colour, 4> sides();

} // namespace spia::viewer::palette
