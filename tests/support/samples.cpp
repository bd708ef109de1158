#include "tests/support/samples.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/support/fender.h"
#include "tests/support/inner_panel.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"

namespace spia::shapes {

const std::vector<Sample>& samples()
{
    static const std::vector<Sample> list = {
        {"square-cup", "square cup with a flange, vertical walls", 5000,
         [](int n) { return square_cup({.triangles = n}); }},
        {"square-cup-draft", "the same with walls drafted by 1 degree", 5000,
         [](int n) { return square_cup({.draft_deg = 1, .triangles = n}); }},
        {"dome", "dome with a flange", 4000, [](int n) { return dome({.triangles = n}).mesh; }},
        {"sharp-cup", "round cup with a sharp edge", 3000, [](int n) { return sharp_cup({.triangles = n}).mesh; }},
        {"sphere-cap", "cap of a sphere", 2000, [](int n) { return sphere_cap({.triangles = n}).mesh; }},
        {"saddle", "saddle, curved the other way", 2000, [](int n) { return saddle({.triangles = n}); }},
        {"plate", "flat plate with two holes", 2000, [](int n) { return plate({.triangles = n}); }},
        {"quarter-cylinder", "quarter of a cylinder", 2000,
         [](int n) { return quarter_cylinder({.triangles = n}).mesh; }},
        {"cone-sector", "sector of a cone", 2000, [](int n) { return cone_sector({.triangles = n}).mesh; }},
        {"hat-channel", "bent channel with a hat profile", 3000,
         [](int n) { return hat_channel({.triangles = n}).mesh; }},
        {"perforated-channel", "the same with round holes", 5000,
         [](int n) { return perforated_channel({.channel = {.triangles = n}}).mesh; }},
        {"lipped-channel", "bent channel with returned flanges", 4000,
         [](int n) { return lipped_channel({.triangles = n}).mesh; }},
        {"inner-panel", "inner panel: steep walls, pockets, beads, embosses, a window, holes", 7000,
         [](int n) { return inner_panel({.triangles = n}).mesh; }},
        {"fender", "fender-like panel: wheel arch, feature line, flange", 5000,
         [](int n) { return fender({.triangles = n}).mesh; }},
        {"closed-sphere", "no boundary", 2000, [](int n) { return closed_sphere(50, n); }, false},
        {"torus", "no boundary, genus 1", 2000, [](int n) { return torus(60, 20, n); }, false},
        {"moebius-strip", "one side only", 2000, [](int n) { return moebius_strip(50, 20, n); }, false},
        {"two-rectangles", "two components; always 96 triangles", 96, [](int) { return two_rectangles(); }, false},
    };
    return list;
}

const Sample& sample(const std::string& name)
{
    std::string names;
    for (const Sample& one : samples()) {
        if (one.name == name)
            return one;
        names += " " + one.name;
    }
    throw InputError(fmt::format("there is no sample \"{}\"; choose one of:{}", name, names));
}

} // namespace spia::shapes
