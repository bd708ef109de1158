#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/exchange/list_items.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// What can be chosen of a file, and its faces to be looked at.
struct ListedFile {
    FileItems items;
    TriMesh mesh;                    ///< of the preview; polygons without area or place are left out
    std::vector<int> polygon;        ///< per triangle of the mesh: of the preview
    std::optional<RayPicker> picker; ///< of the mesh; none if it is empty
};

/// @throws InputError as list_items()
ListedFile look_into(const std::filesystem::path& file, const Progress& progress);

/// Whether files with this ending (CAD, decks) hold more than faces, and are worth looking into before they are opened.
bool has_choices(const std::filesystem::path& file);

/// Whether an item is `holder` or lies in it.
bool lies_in(const FileItems& items, int item, int holder);

/// The item to begin with: a part is one sheet, so of several the largest that holds no others; -1: the whole file.
int proposed_item(const FileItems& items);

/// What reads the chosen items: their choices, without those that lie in another chosen one; none: the whole file.
std::vector<std::string> choices_of(const FileItems& items, const std::vector<char>& chosen);

/// The items that such choices name; those of no item (faces by numbers) are left out.
std::vector<char> items_of(const FileItems& items, const std::vector<std::string>& choices);

/// A file that is about to be opened.
struct FileListing {
    std::filesystem::path file;
    std::shared_ptr<const ListedFile> listed; ///< null: not yet, or there is a failure
    std::string failure;                      ///< why it cannot be read; empty: none
    std::string step;                         ///< of the work
    double fraction = 0;                      ///< of the work
};

} // namespace spia::viewer
