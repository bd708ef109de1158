#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/picking/clip_plane.h"

namespace spia::viewer {

/// An sRGB colour with opacity, 0..1.
using Colour = std::array<float, 4>;

/// Triangles in the renderer's single precision. Finished and const: its address tells whether it
/// is uploaded already. Face f of a mesh of the part or the blank is face f of the part.
struct SceneMesh {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< mm; what is added to every position
    Eigen::Matrix3Xf position;                        ///< 3 by #V, mm from the origin
    Eigen::Matrix3Xf normal; ///< 3 by #V, unit, on the outer side; where it is 0 the face's counts
    Eigen::Matrix<uint32_t, 3, Eigen::Dynamic> triangle;
    Eigen::Matrix<uint32_t, 2, Eigen::Dynamic> edge;    ///< every edge once
    Eigen::Matrix<uint32_t, 2, Eigen::Dynamic> feature; ///< of these the boundary and the sharp
                                                        ///< ones
    std::vector<uint32_t> repeated;                     ///< the last vertices repeat these, with
                                                        ///< the normal of another side of a sharp
                                                        ///< edge
};

/// A scalar over a SceneMesh, one value per vertex (smooth) or per face.
struct SceneField {
    Eigen::VectorXf value;
    bool per_face = false;
};

/// Why a face is drawn otherwise than its neighbours; per face of a SceneMesh one byte: 0, or the
/// number of a region + 1 (at most 63), with these bits added.
struct FaceMarks {
    static constexpr uint8_t region = 0x3f, hovered = 0x40, selected = 0x80;
    std::vector<uint8_t> mark;
};

enum class ColourMap { viridis, diverging, grey, quality, zones };

/// How values become colours.
struct ColourScale {
    ColourMap map = ColourMap::viridis;
    float least = 0, greatest = 1;
    int bands = 0;         ///< of one colour each; 0: smooth
    bool isolines = false; ///< a line at every tick of the legend
    int ticks = 10;        ///< intervals of the legend; with bands their number
    double shown = 1;      ///< what is written beside the colours is so many times the value:
                           ///< 1/25.4 of lengths in inch
};

struct SceneLines {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Matrix3Xf point; ///< 3 by 2 #lines: each pair is a line; mm from the origin
    Colour colour{0, 0, 0, 1};
    float width = 1;     ///< pixels at content scale 1
    bool on_top = false; ///< drawn over everything, else hidden by what is in front
};

struct ScenePoints {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Matrix3Xf point; ///< 3 by #points, mm from the origin
    Colour colour{0, 0, 0, 1};
    float size = 6; ///< pixels across at content scale 1
    bool on_top = true;
};

/// What a label says; the first kinds get their place first.
enum class LabelKind { watched, corner, region };

/// A short text at a place in space; the panels draw it, not the renderer.
struct SceneLabel {
    Eigen::Vector3d place; ///< mm
    std::string text;
    Colour colour{0, 0, 0, 1};
    LabelKind kind = LabelKind::watched;

    friend bool operator==(const SceneLabel&, const SceneLabel&) = default;
};

/// Where a smooth field has one value. Needed for the numbers on the lines; the renderer draws the
/// lines by itself.
struct Isoline {
    double value = 0;
    Eigen::Matrix3Xd point; ///< 3 by #points, mm; of a closed line the last one is the first
};

/// A circle of some pixels around a place in space; the panels draw it, not the renderer.
struct SceneRing {
    Eigen::Vector3d place; ///< mm
};

/// What the colours of a scene mean; the panels draw it.
struct SceneLegend {
    std::string title; ///< e.g. "Thinning"
    std::string unit;  ///< "" for a pure number
    ColourScale scale;
    bool below = false, above = false; ///< there are values outside of the scale, in the colours of
                                       ///< its ends
    std::string note = "";             ///< a line under the title; empty: none
};

/// One layer of triangles and how it is drawn.
struct SceneLayer {
    std::shared_ptr<const SceneMesh> mesh;
    std::shared_ptr<const SceneField> field; ///< null: the plain colour
    std::shared_ptr<const FaceMarks> marks;  ///< null: none
    ColourScale scale;
    Colour colour{0.72f, 0.75f, 0.78f, 1}; ///< of the outer side without a field; opacity below 1
                                           ///< is blended, drawn last
    Colour back{0.55f, 0.42f, 0.36f, 1};   ///< of the inner side without a field
    bool lit = true;                       ///< shaded; a flat blank is not
    bool zebra = false;                    ///< the stripes of lamps in a row, over the plain colour
    bool edges = false;                    ///< draw every edge
    bool features = true;                  ///< draw boundary and sharp edges
};

/// All that one view shows.
struct Scene {
    std::vector<SceneLayer> layers;
    std::vector<std::shared_ptr<const SceneLines>> lines;
    std::vector<std::shared_ptr<const ScenePoints>> points;
    std::vector<SceneLabel> labels;
    std::vector<SceneRing> rings;
    std::optional<std::array<Eigen::Vector3d, 3>>
        hovered; ///< corners of the face under the mouse, mm; the panels draw it
    std::shared_ptr<const std::vector<Isoline>> isolines; ///< null: none are shown
    std::optional<SceneLegend> legend;                    ///< of the field that is shown
    std::vector<Colour> region_colours;                   ///< by number of region
    std::optional<HalfSpace> kept;                        ///< what is beyond is cut away; nothing:
                                                          ///< all is shown
    Eigen::AlignedBox3d box;                              ///< mm, around everything worth seeing:
                                                          ///< what "fit" shows
    std::string empty;                                    ///< if there is nothing to show: what to
                                                          ///< do about it
};

} // namespace spia::viewer
