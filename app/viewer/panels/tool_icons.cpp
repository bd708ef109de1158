#include "app/viewer/panels/tool_icons.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace spia::viewer {
namespace {

/// Lines and dots in a square of 16 by 16 units, its upper left corner at 0.
class Sketch {
public:
    Sketch(ImDrawList* draw, ImVec2 from, float size, ImU32 ink, ImU32 accent)
        : draw_(draw), from_(from), unit_(size / 16), ink_(ink), accent_(accent),
          // Whole pixels look sharp; at scale 1 thinner ones would be pale.
          stroke_(std::max(1.25f, std::round(1.35f * unit_ * 4) / 4))
    {
    }

    void line(std::initializer_list<ImVec2> points, bool closed = false) const { stroke(at(points), ink_, closed); }
    void strong(std::initializer_list<ImVec2> points, bool closed = false) const
    {
        stroke(at(points), accent_, closed);
    }
    void area(std::initializer_list<ImVec2> points) const // convex, clockwise
    {
        const std::vector<ImVec2> p = at(points);
        draw_->AddConvexPolyFilled(p.data(), int(p.size()), accent_);
    }
    void dot(ImVec2 middle, float radius = 1.9f) const
    {
        draw_->AddCircleFilled(at(middle), std::max(1.8f, radius * unit_), accent_, 16);
    }
    void ring(ImVec2 middle, float radius) const { draw_->AddCircle(at(middle), radius * unit_, ink_, 24, stroke_); }
    void curve(ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d) const
    {
        draw_->AddBezierCubic(at(a), at(b), at(c), at(d), ink_, stroke_, 16);
    }
    /// Dashes along a straight line.
    void dashes(ImVec2 a, ImVec2 b, int count) const
    {
        for (int k = 0; k < count; ++k) {
            const float from = float(2 * k) / float(2 * count - 1), to = float(2 * k + 1) / float(2 * count - 1);
            stroke({at({a.x + from * (b.x - a.x), a.y + from * (b.y - a.y)}),
                    at({a.x + to * (b.x - a.x), a.y + to * (b.y - a.y)})},
                   ink_, false);
        }
    }

private:
    ImVec2 at(ImVec2 p) const { return {from_.x + unit_ * p.x, from_.y + unit_ * p.y}; }
    std::vector<ImVec2> at(std::initializer_list<ImVec2> points) const
    {
        std::vector<ImVec2> result;
        for (const ImVec2 p : points)
            result.push_back(at(p));
        return result;
    }
    void stroke(const std::vector<ImVec2>& points, ImU32 colour, bool closed) const
    {
        draw_->AddPolyline(points.data(), int(points.size()), colour, closed ? ImDrawFlags_Closed : ImDrawFlags_None,
                           stroke_);
    }

    ImDrawList* draw_;
    ImVec2 from_;
    float unit_;
    ImU32 ink_, accent_;
    float stroke_;
};

} // namespace

void draw_tool_icon(ImDrawList* draw, Tool tool, ImVec2 from, float size, ImU32 ink, ImU32 accent)
{
    const Sketch s(draw, from, size, ink, accent);
    switch (tool) {
    case Tool::look: // an eye
        s.curve({1, 8}, {4.5f, 2.6f}, {11.5f, 2.6f}, {15, 8});
        s.curve({1, 8}, {4.5f, 13.4f}, {11.5f, 13.4f}, {15, 8});
        s.dot({8, 8}, 2.4f);
        return;
    case Tool::pick: // one triangle of several
        s.area({{8, 2}, {14, 13}, {2, 13}});
        s.line({{8, 2}, {14, 13}, {2, 13}}, true);
        return;
    case Tool::box:
        s.dashes({2, 3}, {14, 3}, 4);
        s.dashes({14, 3}, {14, 13}, 3);
        s.dashes({14, 13}, {2, 13}, 4);
        s.dashes({2, 13}, {2, 3}, 3);
        s.area({{5.5f, 6}, {10.5f, 6}, {10.5f, 10}, {5.5f, 10}});
        return;
    case Tool::lasso: // a noose with its end
        s.curve({5, 11}, {-1, 8.5f}, {2, 2}, {8.5f, 2});
        s.curve({8.5f, 2}, {16, 2}, {16, 10}, {9, 11});
        s.curve({9, 11}, {7.5f, 11.3f}, {6.2f, 11.4f}, {5, 11});
        s.curve({5, 11}, {3.6f, 12.2f}, {5.6f, 13}, {4, 15});
        s.dot({5, 11}, 1.7f);
        return;
    case Tool::brush:
        s.line({{14, 2}, {7.5f, 8.5f}});
        s.line({{14, 2}, {9.2f, 9.6f}});
        s.area({{6.6f, 7.6f}, {9.4f, 10.2f}, {7, 13}, {2, 14}, {3.6f, 9.6f}});
        return;
    case Tool::flood: // from one triangle to those around it
        s.line({{8, 1.5f}, {15, 14}, {1, 14}}, true);
        s.area({{4.5f, 7.8f}, {11.5f, 7.8f}, {8, 14}});
        s.line({{4.5f, 7.8f}, {11.5f, 7.8f}, {8, 14}}, true);
        return;
    case Tool::smooth_region: // a bent sheet up to its edge
        s.curve({2, 10}, {6, 10}, {6, 4}, {10, 4});
        s.curve({6, 14}, {10, 14}, {10, 8}, {14, 8});
        s.line({{2, 10}, {6, 14}});
        s.line({{10, 4}, {14, 8}});
        s.dot({8, 9}, 2.2f);
        return;
    case Tool::vertex: // where edges meet
        s.line({{8, 8}, {8, 1.5f}});
        s.line({{8, 8}, {14, 12}});
        s.line({{8, 8}, {2, 12}});
        s.dot({8, 8}, 2.4f);
        return;
    case Tool::outline: // a place on a closed line
        s.line({{2.5f, 13}, {2.5f, 6}, {7, 2.5f}, {13.5f, 2.5f}, {13.5f, 13}}, true);
        s.dot({2.5f, 6}, 2.2f);
        return;
    case Tool::corners:
        s.line({{3.5f, 4.5f}, {12.5f, 3}, {12.5f, 13}, {3.5f, 11.5f}}, true);
        for (const ImVec2 corner : {ImVec2(3.5f, 4.5f), ImVec2(12.5f, 3), ImVec2(12.5f, 13), ImVec2(3.5f, 11.5f)})
            s.dot(corner, 1.8f);
        return;
    case Tool::probe: // a pin
        s.ring({9.5f, 5.8f}, 3.6f);
        s.dot({9.5f, 5.8f}, 1.4f);
        s.line({{7.2f, 8.8f}, {2.5f, 14}});
        return;
    case Tool::section: // a cut through a sheet
        s.curve({1.5f, 11}, {5, 11}, {5, 5}, {8, 5});
        s.curve({8, 5}, {11, 5}, {11, 11}, {14.5f, 11});
        s.strong({{8, 1.5f}, {8, 14.5f}});
        return;
    case Tool::measure: // a dimension line
        s.line({{2, 3}, {2, 13}});
        s.line({{14, 3}, {14, 13}});
        s.strong({{2.8f, 8}, {13.2f, 8}});
        s.strong({{5.4f, 5.6f}, {2.8f, 8}, {5.4f, 10.4f}});
        s.strong({{10.6f, 5.6f}, {13.2f, 8}, {10.6f, 10.4f}});
        return;
    case Tool::line: // place by place
        s.line({{2.5f, 12.5f}, {6.5f, 5}, {10, 10.5f}, {13.5f, 3.5f}});
        for (const ImVec2 place : {ImVec2(2.5f, 12.5f), ImVec2(6.5f, 5), ImVec2(10, 10.5f), ImVec2(13.5f, 3.5f)})
            s.dot(place, 1.6f);
        return;
    case Tool::shape: // a net pulled up at one point
        s.curve({1.5f, 13}, {5, 13}, {6.5f, 7.5f}, {8, 7.5f});
        s.curve({8, 7.5f}, {9.5f, 7.5f}, {11, 13}, {14.5f, 13});
        s.strong({{8, 7.5f}, {8, 2}});
        s.strong({{5.6f, 4.4f}, {8, 2}, {10.4f, 4.4f}});
        s.dot({8, 7.5f}, 1.8f);
        return;
    }
}

} // namespace spia::viewer
