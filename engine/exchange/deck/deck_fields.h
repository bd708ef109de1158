#pragma once
#include <array>
#include <span>
#include <string_view>

namespace spia {

/// One card of a deck cut into fields. Fields behind the last one are empty.
class DeckFields {
public:
    static constexpr size_t most = 40;

    void cut_columns(std::string_view line, std::span<const int> widths); ///< characters per field
    void cut_commas(std::string_view line); ///< fields beyond `most` are dropped, count() counts
                                            ///< them
    void cut_words(std::string_view line);  ///< at blanks and tabs

    size_t count() const { return count_; } ///< including empty ones before the last
    std::string_view operator[](size_t i) const { return i < most && i < count_ ? field_[i] : std::string_view(); }

private:
    void add(std::string_view field)
    {
        if (count_ < most)
            field_[count_] = field;
        ++count_;
    }
    std::array<std::string_view, most> field_;
    size_t count_ = 0;
};

} // namespace spia
