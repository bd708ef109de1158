#include "app/viewer/model/document/file_listing.h"

#include <algorithm>

#include "engine/core/read_number.h"
#include "engine/exchange/part_formats.h"

namespace spia::viewer {
namespace {

/// Polygons as fans of triangles; what a damaged file has beside them is not to be seen.
void triangulate(const PolygonSoup& soup, ListedFile& listed)
{
    listed.mesh.position.resize(3, soup.vertices());
    for (int v = 0; v < soup.vertices(); ++v)
        listed.mesh.position.col(v) = soup.position[size_t(v)];
    const auto usable = [&](int v) { return v >= 0 && v < soup.vertices() && soup.position[size_t(v)].allFinite(); };
    std::vector<Eigen::Vector3i> triangle;
    for (int p = 0; p < soup.polygons(); ++p) {
        const auto corners = soup.polygon(p);
        if (!std::all_of(corners.begin(), corners.end(), usable))
            continue;
        for (size_t k = 1; k + 1 < corners.size(); ++k) {
            const int a = corners[0], b = corners[k], c = corners[k + 1];
            if (a == b || b == c || c == a)
                continue;
            triangle.emplace_back(a, b, c);
            listed.polygon.push_back(p);
        }
    }
    for (int v = 0; v < soup.vertices(); ++v)
        if (!soup.position[size_t(v)].allFinite())
            listed.mesh.position.col(v).setZero(); // no triangle has it
    listed.mesh.triangle.resize(3, Eigen::Index(triangle.size()));
    for (size_t t = 0; t < triangle.size(); ++t)
        listed.mesh.triangle.col(Eigen::Index(t)) = triangle[t];
}

} // namespace

ListedFile look_into(const std::filesystem::path& file, const Progress& progress)
{
    ListedFile listed;
    listed.items = list_items(file, progress.part(0, 0.8));
    progress.checkpoint(0.8, "preparing the preview");
    for (const FileItem& item : listed.items.item) // holders come first
        listed.depth.push_back(item.parent < 0 ? 0 : listed.depth[size_t(item.parent)] + 1);
    triangulate(listed.items.preview, listed);
    if (listed.mesh.triangles() > 0)
        listed.picker.emplace(listed.mesh);
    progress.checkpoint(1, "preparing the preview");
    return listed;
}

bool has_choices(const std::filesystem::path& file)
{
    const std::optional<FileKind> kind = kind_of_file(file);
    return kind && *kind != FileKind::mesh;
}

int proposed_item(const FileItems& items)
{
    const int count = int(items.item.size());
    std::vector<char> holds(items.item.size(), 0);
    int choosable = 0;
    for (const FileItem& item : items.item) {
        choosable += !item.choice.empty();
        if (item.parent >= 0)
            holds[size_t(item.parent)] = 1;
    }
    int best = -1;
    for (int i = 0; i < count; ++i) {
        const FileItem& item = items.item[size_t(i)];
        if (!holds[size_t(i)] && !item.choice.empty() && item.faces > 0 &&
            (best < 0 || item.area > items.item[size_t(best)].area))
            best = i;
    }
    // A skin of which each face is a body of its own: sewn they are one sheet.
    const auto single_face = [](const FileItem& item) { return item.kind != "sheet body" || item.faces <= 1; };
    const bool loose = best >= 0 && items.item[size_t(best)].kind == "sheet body" &&
                       std::all_of(items.item.begin(), items.item.end(), single_face);
    return choosable > 1 && !loose ? best : -1;
}

std::vector<char> with_what_they_hold(const FileItems& items, std::vector<char> chosen)
{
    for (size_t i = 0; i < items.item.size(); ++i) // holders come first
        if (const int holder = items.item[i].parent; holder >= 0 && chosen[size_t(holder)])
            chosen[i] = 1;
    return chosen;
}

std::vector<std::string> choices_of(const FileItems& items, const std::vector<char>& chosen)
{
    std::vector<std::string> choices;
    const std::vector<char> held = with_what_they_hold(items, chosen);
    for (size_t i = 0; i < items.item.size(); ++i) {
        const FileItem& item = items.item[i];
        if (chosen[i] && !(item.parent >= 0 && held[size_t(item.parent)]) && !item.choice.empty())
            choices.push_back(item.choice);
    }
    return choices;
}

ChosenItems items_of(const FileItems& items, const std::vector<std::string>& choices)
{
    ChosenItems chosen{std::vector<char>(items.item.size(), 0), {}};
    const auto take = [&](const auto& named) { // if there is one
        const auto found = std::find_if(items.item.begin(), items.item.end(), named);
        if (found == items.item.end())
            return false;
        chosen.item[size_t(found - items.item.begin())] = 1;
        return true;
    };
    for (const std::string& choice : choices) {
        const auto chosen_by = [&](const FileItem& item) { return !item.choice.empty() && item.choice == choice; };
        const auto called = [&](const FileItem& item) { return !item.choice.empty() && item.name == choice; };
        const auto called_like = [&](const FileItem& item) {
            return !item.choice.empty() && same_letters(item.name, choice);
        };
        if (!take(chosen_by) && !take(called) && !take(called_like))
            chosen.others.push_back(choice);
    }
    return chosen;
}

} // namespace spia::viewer
