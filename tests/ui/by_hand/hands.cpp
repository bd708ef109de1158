#include "tests/ui/by_hand/hands.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

using Clock = std::chrono::steady_clock;

/// Of lines that say the same the one that is drawn last: it lies over the others.
std::optional<Json> line_in(const Json& report, const std::string& wanted, bool whole)
{
    if (report.is_null())
        return std::nullopt;
    const Json& texts = report["window"]["texts"];
    for (auto text = texts.rbegin(); text != texts.rend(); ++text) {
        const auto& said = (*text)["text"].get_ref<const std::string&>();
        if (whole ? said == wanted : said.find(wanted) != said.npos)
            return *text;
    }
    return std::nullopt;
}

std::pair<double, double> place(const Json& text, double x, double y)
{
    return {text["at"][0].get<double>() + x * text["size"][0].get<double>(),
            text["at"][1].get<double>() + y * text["size"][1].get<double>()};
}

} // namespace

Hands::Hands(const std::filesystem::path& folder, const std::vector<std::string>& arguments)
    : viewer_(folder, arguments)
{
}

Json Hands::waited(const std::string& what, const std::function<bool(const Json&)>& fulfilled)
{
    const auto start = Clock::now();
    Json now = viewer_.wait(what, fulfilled, waiting_limit);
    longest_ = std::max(longest_, std::chrono::duration<double>(Clock::now() - start).count());
    return now;
}

Json Hands::see(const std::string& line)
{
    return waited("the words \"" + line + "\"", [&](const Json& now) { return line_in(now, line, true).has_value(); });
}
Json Hands::see_part_of_line(const std::string& part)
{
    return waited("a line with \"" + part + "\"",
                  [&](const Json& now) { return line_in(now, part, false).has_value(); });
}
void Hands::see_no(const std::string& part)
{
    waited("no more of the words \"" + part + "\"", [&](const Json& now) { return !line_in(now, part, false); });
}
bool Hands::sees_now(const std::string& line) const { return line_in(viewer_.report(), line, true).has_value(); }

bool Hands::sees_chosen(const std::string& line) const
{
    const Json now = viewer_.report();
    const Json& texts = now["window"]["texts"];
    return std::count_if(texts.begin(), texts.end(), [&](const Json& text) { return text["text"] == line; }) > 1;
}
bool Hands::sees_marked(const std::string& line) const
{
    const Json now = viewer_.report();
    const Json& marked = now["window"]["marked"];
    if (marked.is_null())
        return false;
    // What begins at the left of the frame; drawn last it lies over the others.
    std::string label;
    for (const Json& text : now["window"]["texts"]) {
        const auto [x, y] = place(text, 0, 0.5);
        const double left = marked["at"][0];
        if (x >= left - 1 && x <= left + 40 && y >= marked["at"][1] && y <= marked["to"][1])
            label = text["text"];
    }
    return label == line || label.ends_with("/" + line);
}

Json Hands::see_that(const std::string& what, const std::function<bool(const Json&)>& fulfilled)
{
    return waited(what, fulfilled);
}
Json Hands::see_ready()
{
    return waited("a window at rest", [](const Json& now) { return now["job"]["running"] == false; });
}

void Hands::click(const std::string& line, double x, double y) { click_on(line, true, x, y); }
void Hands::rest_on(const std::string& line) { rest_on(line, true, 0.5, 0.5); }
void Hands::click_part(const std::string& part) { click_on(part, false, 0.5, 0.5); }

void Hands::click_on(const std::string& words, bool whole, double x, double y)
{
    rest_on(words, whole, x, y);
    viewer_.press(1);
    viewer_.release(1);
}

void Hands::rest_on(const std::string& words, bool whole, double x, double y)
{
    for (int tries = 0; tries < 20; ++tries) {
        const Json before = whole ? see(words) : see_part_of_line(words);
        const auto at = place(*line_in(before, words, whole), x, y);
        const Json now = viewer_.move(at.first, at.second);
        const auto still = line_in(now, words, whole);
        if (still && place(*still, x, y) == at)
            return;
    }
    throw Error("\"" + words + "\" does not stand still under the mouse");
}

Json Hands::scroll_to(const std::string& line, double x, double y, bool whole)
{
    Json now = viewer_.move(x, y);
    for (const int way : {-1, 1}) // down, then back up
        for (int notches = 0; notches < 60; ++notches) {
            if (line_in(now, line, whole))
                return now;
            viewer_.wheel(way);
            x += notches % 2 ? -1 : 1; // a report comes when the mouse has moved
            now = viewer_.move(x, y);
        }
    throw Error("\"" + line + "\" is nowhere in the panel");
}

void Hands::double_click(const std::string& line)
{
    const auto at = place(*line_in(see(line), line, true), 0.5, 0.5);
    viewer_.move(at.first, at.second);
    viewer_.double_click(80);
}

void Hands::click_beside(const std::string& line, double dx, double dy)
{
    const auto at = place(*line_in(see(line), line, true), 0.5, 0.5);
    viewer_.click(at.first + dx, at.second + dy);
}

void Hands::click_at(double x, double y) { viewer_.click(x, y); }

void Hands::tool(const std::string& name)
{
    const std::string item = "tool " + name;
    const Json now = waited("the tool " + name, [&](const Json& r) { return r["window"]["items"].contains(item); });
    const auto at = place(now["window"]["items"][item], 0.5, 0.5);
    viewer_.click(at.first, at.second);
}

void Hands::open_menu(const std::string& title, const std::string& entry)
{
    constexpr auto wonders = std::chrono::seconds(3); // then a person clicks once more
    click(title);
    const auto until = Clock::now() + wonders;
    while (!sees_now(entry) && Clock::now() < until)
        viewer_.rest();
    if (sees_now(entry))
        return;
    std::printf("the menu %s did not open at the first click\n", title.c_str());
    click(title);
    see(entry);
}

void Hands::menu(const std::string& title, const std::string& entry)
{
    open_menu(title, entry);
    click(entry);
}

void Hands::menu(const std::string& title, const std::string& entry, const std::string& under)
{
    menu(title, entry);
    click(under);
}

void Hands::menu_by_keys(const std::string& title, const std::string& entry, const std::string& under)
{
    // One step at a time: the mark has moved before the next key; at an end of the row it turns
    // round.
    const auto go_to = [&](const std::string& line, const char* on, const char* back) {
        const auto until = Clock::now() + std::chrono::seconds(60); // pressing keys is no waiting
        // a key that came late would move it on
        const auto stays_at = [&] {
            if (!sees_marked(line))
                return false;
            viewer_.rest();
            return sees_marked(line);
        };
        for (const char* key = on; !stays_at();) {
            if (Clock::now() > until)
                throw Error("\"" + line + "\" is not reached by the keys " + on + " and " + back);
            const Json before = viewer_.report()["window"]["marked"];
            keys(key);
            // 1 s was too short on a loaded machine
            const auto moved_by = Clock::now() + std::chrono::seconds(3);
            while (viewer_.report()["window"]["marked"] == before && Clock::now() < moved_by)
                viewer_.rest();
            if (viewer_.report()["window"]["marked"] == before)
                key = key == on ? back : on;
        }
    };
    const auto in_bar = [](const Json& now) { // a title of the menu bar, at the upper edge of the
                                              // window, is marked
        const Json& marked = now["window"]["marked"];
        return !marked.is_null() && marked["at"][1].get<double>() < 10;
    };
    viewer_.hold("Alt_L");
    viewer_.rest();
    viewer_.let_go("Alt_L");
    see_that("the menu bar at the keyboard", in_bar);
    go_to(title, "Right", "Left");
    keys("Return");
    see_part_of_line(entry);
    go_to(entry, "Down", "Up");
    if (!under.empty()) {
        keys("Right");
        see_part_of_line(under);
        go_to(under, "Down", "Up");
    }
    keys("Return");
}

void Hands::keys(const std::string& combination) { viewer_.keys(combination); }
void Hands::type(const std::string& text) { viewer_.type(text); }
void Hands::size(int width, int height)
{
    viewer_.resize(width, height);
    see_that("the size of the window", [&](const Json& now) {
        return now["window"]["size"] == Json{float(width), float(height)};
    });
}

} // namespace spia::viewer
