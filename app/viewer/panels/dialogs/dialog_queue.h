#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace spia::viewer {

/// The modal dialogs that want to be on the screen. One of them is, the others wait for their turn:
/// two that opened in one frame would close each other, and the window would hold still for a
/// dialog that nobody sees. A dialog is known by its title.
class DialogQueue {
public:
    /// No matter whether it wants to already. @param urgent goes before the others, which come back
    /// when it has been answered
    void want(const std::string& title, bool urgent)
    {
        if (wants(title))
            return;
        if (urgent)
            wanted_.insert(wanted_.begin(), title);
        else
            wanted_.push_back(title);
    }
    bool wants(const std::string& title) const
    {
        return std::find(wanted_.begin(), wanted_.end(), title) != wanted_.end();
    }
    void leave(const std::string& title)
    {
        std::erase(wanted_, title);
        if (opened_ == title)
            opened_.clear();
    }

    bool shows(const std::string& title) const { return !wanted_.empty() && wanted_.front() == title; }
    /// Whether ImGui has been told to open it; what was before is closed by that.
    bool opened(const std::string& title) const { return opened_ == title; }
    void open(const std::string& title)
    {
        opened_ = title;
        ++openings_;
    }
    /// How many times a dialog was opened so far.
    int openings() const { return openings_; }
    bool empty() const { return wanted_.empty(); }

    /// To be called for each dialog that is drawn, or waits, in this frame.
    void seen(const std::string& title) { seen_.push_back(title); }
    /// Those that were not drawn in this frame have lost what they were about. @returns whether the
    /// one on the screen has
    bool end_frame()
    {
        std::erase_if(wanted_, [&](const std::string& title) {
            return std::find(seen_.begin(), seen_.end(), title) == seen_.end();
        });
        seen_.clear();
        const bool gone = !opened_.empty() && !wants(opened_);
        if (gone)
            opened_.clear();
        return gone;
    }

private:
    std::vector<std::string> wanted_, seen_;
    std::string opened_;
    int openings_ = 0;
};

} // namespace spia::viewer
