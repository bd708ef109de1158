#include "app/viewer/model/file_listing.h"

#include <algorithm>
#include <cctype>

#include "engine/exchange/read_cad.h"
#include "engine/exchange/read_deck.h"

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
    triangulate(listed.items.preview, listed);
    if (listed.mesh.triangles() > 0)
        listed.picker.emplace(listed.mesh);
    progress.checkpoint(1, "preparing the preview");
    return listed;
}

bool has_choices(const std::filesystem::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return is_cad(ending) || is_deck(ending);
}

bool lies_in(const FileItems& items, int item, int holder)
{
    for (; item >= 0; item = items.item[size_t(item)].parent)
        if (item == holder)
            return true;
    return false;
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
    return choosable > 1 ? best : -1;
}

std::vector<std::string> choices_of(const FileItems& items, const std::vector<char>& chosen)
{
    std::vector<std::string> choices;
    for (int i = 0; i < int(items.item.size()); ++i) {
        const FileItem& item = items.item[size_t(i)];
        bool held = false;
        for (int holder = item.parent; holder >= 0; holder = items.item[size_t(holder)].parent)
            held = held || chosen[size_t(holder)];
        if (chosen[size_t(i)] && !held && !item.choice.empty())
            choices.push_back(item.choice);
    }
    return choices;
}

std::vector<char> items_of(const FileItems& items, const std::vector<std::string>& choices)
{
    std::vector<char> chosen(items.item.size(), 0);
    for (size_t i = 0; i < items.item.size(); ++i)
        chosen[i] = !items.item[i].choice.empty() &&
                    std::find(choices.begin(), choices.end(), items.item[i].choice) != choices.end();
    return chosen;
}

} // namespace spia::viewer
