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
    std::vector<int> depth;          ///< per item: how many hold it
    TriMesh mesh;                    ///< of the preview; polygons without area or place are left
                                     ///< out
    std::vector<int> polygon;        ///< per triangle of the mesh: of the preview
    std::optional<RayPicker> picker; ///< of the mesh; none if it is empty
};

/// @throws InputError as list_items()
ListedFile look_into(const std::filesystem::path& file, const Progress& progress);

/// Whether files with this ending (CAD, decks) hold more than faces, and are worth looking into
/// before they are opened.
bool has_choices(const std::filesystem::path& file);

/// The item to begin with: a part is one sheet, so of several the largest that holds no others; -1:
/// the whole file, also if each face is a sheet body of its own.
int proposed_item(const FileItems& items);

/// What reads the chosen items: their choices, without those that lie in another chosen one; none:
/// the whole file.
std::vector<std::string> choices_of(const FileItems& items, const std::vector<char>& chosen);

/// What some choices name: by the choices of items or by their names, in any case of letters if
/// there is one only.
struct ChosenItems {
    std::vector<char> item;          ///< per item
    std::vector<std::string> others; ///< those of no item: faces by their numbers
};
ChosenItems items_of(const FileItems& items, const std::vector<std::string>& choices);

/// Per item whether it or what holds it is one of these.
std::vector<char> with_what_they_hold(const FileItems& items, std::vector<char> chosen);

/// A file that is about to be opened.
struct FileListing {
    std::filesystem::path file;
    bool again = false;                            ///< it is that of the part, which is read
                                                   ///< otherwise
    std::shared_ptr<const ListedFile> listed = {}; ///< null: not yet, or there is a failure
    std::string failure = {};                      ///< why it cannot be read; empty: none
    std::string step = {};                         ///< of the work
    double fraction = 0;                           ///< of the work
};

} // namespace spia::viewer
