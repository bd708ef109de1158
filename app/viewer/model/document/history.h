#pragma once
#include <string>
#include <vector>

#include "app/viewer/model/document/document.h"

namespace spia::viewer {

/// Documents of the past and, after undo, of the future, each with the name of the change that left
/// it.
class History {
public:
    /// Remembers the document as it was before a change.
    /// @param merge  changes of the same name in a row count as one (a drag, a slider): only the
    /// first is remembered
    void remember(std::string name, const Document& before, bool merge = false);

    /// Name of the change that undo (redo) would take back (do again); empty: there is none.
    std::string undo_name() const;
    std::string redo_name() const;

    /// @param current replaced by the document before (after) the change; no effect if there is
    /// none
    void undo(Document& current);
    void redo(Document& current);
    /// A number for the document as it is now: another one after each change, the former one again
    /// after undo.
    int now() const { return now_; }
    /// Whether the document as it is now came about by way of the one with this number.
    bool has(int number) const;
    /// How many changes undo could take back now; for update_since().
    size_t depth() const { return forgotten_ + past_.size(); }
    /// Changes made since then go back to a document that has been altered like this: a result that
    /// arrives in between belongs to neither of them.
    template <class Alter> void update_since(size_t depth, const Alter& alter)
    {
        for (size_t k = depth > forgotten_ ? depth - forgotten_ : 0; k < past_.size(); ++k)
            alter(past_[k].document);
        for (Entry& entry : future_)
            alter(entry.document);
    }

    /// The last change has come to nothing: what is there now is what was there before.
    void forget_last()
    {
        if (past_.empty())
            return;
        now_ = past_.back().number;
        past_.pop_back();
    }
    /// The next change is not merged with the last one, whatever its name.
    void close() { open_ = false; }

private:
    struct Entry {
        std::string name;
        Document document;
        int number; ///< of the document
    };
    static constexpr size_t most_ = 100;
    std::vector<Entry> past_, future_;
    size_t forgotten_ = 0;   ///< changes that are too old to be taken back
    int now_ = 0, last_ = 0; ///< numbers of documents: of this one, and the greatest so far
    int oldest_ = 0;         ///< of the oldest document that can be brought back
    bool open_ = false;
};

} // namespace spia::viewer
