#include "app/viewer/model/jobs/file_writer.h"

namespace spia::viewer {

std::vector<FileWriter::Ended> FileWriter::take_ended()
{
    std::vector<Ended> ended;
    while (!pending_.empty() && pending_.front().written.ready()) {
        ended.push_back({std::move(pending_.front().file), {}});
        try {
            pending_.front().written.get();
        } catch (const std::exception& error) {
            ended.back().error = error.what();
        }
        pending_.erase(pending_.begin());
    }
    return ended;
}

} // namespace spia::viewer
