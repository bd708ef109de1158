#include "app/viewer/model/document/suggested_files.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

bool lies_in(const fs::path& file, const fs::path& folder)
{
    std::error_code ignored;
    const fs::path inner = fs::weakly_canonical(file, ignored), outer = fs::weakly_canonical(folder, ignored);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

} // namespace

fs::path working_folder(const ViewerState& state, const std::vector<fs::path>& recent, const fs::path& assets)
{
    std::vector<fs::path> files = {state.project, state.document.session.file};
    files.insert(files.end(), recent.begin(), recent.end());
    std::error_code ignored;
    for (const fs::path& file : files) {
        if (file.empty())
            continue;
        const fs::path folder = fs::absolute(file, ignored).parent_path();
        if (fs::is_directory(folder, ignored) && !lies_in(folder, assets))
            return folder;
    }
    return fs::current_path(ignored);
}

fs::path suggested_file(const ViewerState& state, const std::vector<fs::path>& recent, const fs::path& assets,
                        const std::string& ending)
{
    const fs::path& about = state.project.empty() ? state.document.session.file : state.project;
    return working_folder(state, recent, assets) / ((about.empty() ? "part" : about.stem().string()) + ending);
}

} // namespace spia::viewer
