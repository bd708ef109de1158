#include "app/viewer/model/document/history.h"

#include <algorithm>
#include <utility>

namespace spia::viewer {

void History::remember(std::string name, const Document& before, bool merge)
{
    future_.clear();
    const bool same = merge && open_ && !past_.empty() && past_.back().name == name;
    open_ = merge;
    const int number = std::exchange(now_, ++last_);
    if (same)
        return;
    past_.push_back({std::move(name), before, number});
    if (past_.size() > most_) {
        past_.erase(past_.begin());
        oldest_ = past_.front().number;
        ++forgotten_;
    }
}

bool History::has(int number) const
{
    // What is too old to be taken back is still so.
    return number == now_ || number < oldest_ ||
           std::any_of(past_.begin(), past_.end(), [&](const Entry& entry) { return entry.number == number; });
}

std::string History::undo_name() const { return past_.empty() ? "" : past_.back().name; }
std::string History::redo_name() const { return future_.empty() ? "" : future_.back().name; }

void History::undo(Document& current)
{
    if (past_.empty())
        return;
    open_ = false;
    std::swap(current, past_.back().document);
    std::swap(now_, past_.back().number);
    future_.push_back(std::move(past_.back()));
    past_.pop_back();
}

void History::redo(Document& current)
{
    if (future_.empty())
        return;
    open_ = false;
    std::swap(current, future_.back().document);
    std::swap(now_, future_.back().number);
    past_.push_back(std::move(future_.back()));
    future_.pop_back();
}

} // namespace spia::viewer
