#pragma once
#include <string_view>
#include <vector>

namespace spia {

/// The lines of a text, cut into words; says where it is when something is wrong.
class TextLines {
public:
    /// @param comment  the rest of a line from this character on is ignored; 0: there are no
    /// comments
    /// @param joined   a backslash at the end joins a line with the next
    explicit TextLines(std::string_view text, char comment = '#', bool joined = false)
        : rest_(text), comment_(comment), joined_(joined)
    {
    }

    bool next(); ///< goes to the next line with a word in it; false at the end of the text
    const std::vector<std::string_view>& words() const { return words_; }
    std::string_view rest() const { return rest_; } ///< what follows the current line

    /// Word i as a coordinate. @throws InputError if it is no finite number of a sensible size
    double coordinate(size_t i) const;
    /// Word i as any number; not a number if it is none
    double number_or_nan(size_t i) const;
    /// Word i as a whole number. @throws InputError if it is none
    int integer(size_t i) const;
    [[noreturn]] void fail(std::string_view what) const; ///< @throws InputError "line 12: what"

private:
    void cut(std::string_view line);

    std::string_view rest_;
    char comment_;
    bool joined_;
    long line_ = 0;
    std::vector<std::string_view> words_;
};

/// A coordinate larger than this is damage, not a length; it still fits into single precision.
constexpr double largest_coordinate = 1e30;

} // namespace spia
