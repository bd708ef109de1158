#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// The values of a mesh file of Gmsh, record after record: the words of a line or, in a binary
/// file, bytes. Both come in the same order.
class GmshValues {
public:
    explicit GmshValues(DeckLines& lines) : lines_(lines) {}

    /// What follows is binary, and first of all the number 1, which tells the order of bytes.
    /// @param size_bytes  of a number of the kind 'z', 4 or 8
    void begin_binary(std::int64_t size_bytes);
    bool binary() const { return binary_; }

    /// Goes to the next record of a section. @param kinds of the values of a binary one, a letter
    /// each: 'i' a whole number of 4 bytes, 'z' a count or tag, 'd' a real number of 8 bytes
    void next(std::string_view kinds);
    void next_line(); ///< of what is text in binary files, too
    /// Further values of the record: in a line they are there already. @param times how often they
    /// come
    void more(std::string_view kinds, std::int64_t times = 1);

    std::int64_t whole(size_t i) const; ///< the value i of the record
    double coordinate(size_t i) const;

private:
    struct Value {
        std::int64_t whole;
        double real;
    };
    Value value_of(char kind, const char* bytes) const;
    size_t bytes_of(char kind) const { return kind == 'i' ? 4 : kind == 'z' ? size_bytes_ : 8; }
    const Value& value(size_t i) const;

    DeckLines& lines_;
    DeckFields fields_;
    std::vector<Value> values_;
    bool binary_ = false, in_words_ = true, swapped_ = false;
    size_t size_bytes_ = 8;
};

} // namespace spia
