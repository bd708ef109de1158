#pragma once
#include <Eigen/Core>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <vector>

#include "engine/exchange/lines/dxf_options.h"

namespace spia {

/// A DXF file is a row of group codes and values, two lines each. Objects name each other by
/// handles; those of the fixed objects are below 0x100. Files of version 12 have neither owners nor
/// the marks of subclasses: they are left out.
class DxfText {
public:
    explicit DxfText(DxfVersion version = DxfVersion::r2000) : r12_(version == DxfVersion::r12) {}

    DxfText& operator()(int code, const char* value) { return r12_ && code == 100 ? *this : line(code, value); }
    DxfText& operator()(int code, const std::string& value) { return (*this)(code, value.c_str()); }
    DxfText& operator()(int code, int value) { return line(code, value); }
    DxfText& operator()(int code, double value) { return line(code, fmt::format("{:#.17g}", value)); }
    DxfText& point(int code, const Eigen::Vector2d& p) { return (*this)(code, p.x())(code + 10, p.y()); }
    DxfText& handle(int code, int value) { return r12_ && code != 5 ? *this : line(code, fmt::format("{:X}", value)); }
    bool r12() const { return r12_; }

    void begin_section(const char* name) { (*this)(0, "SECTION")(2, name); }
    void end_section() { (*this)(0, "ENDSEC"); }

    void begin_table(const char* name, int table, int entries)
    {
        (*this)(0, "TABLE")(2, name);
        if (!r12_)
            handle(5, table).handle(330, 0)(100, "AcDbSymbolTable");
        (*this)(70, entries);
    }
    DxfText& entry(const char* type, const char* subclass, int own, int table, const std::string& name, int flags = 0)
    {
        (*this)(0, type).handle(5, own).handle(330, table)(100, "AcDbSymbolTableRecord")(100, subclass)(2, name);
        return (*this)(70, flags);
    }
    void end_table() { (*this)(0, "ENDTAB"); }

    void append(const DxfText& other) { text_ += other.text_; }
    const std::string& text() const { return text_; }

private:
    template <class Value> DxfText& line(int code, const Value& value)
    {
        fmt::format_to(std::back_inserter(text_), "{:3}\n{}\n", code, value);
        return *this;
    }
    std::string text_;
    bool r12_;
};

struct DxfLayer {
    int handle;
    std::string name;
    int colour;                           ///< of AutoCAD's table
    std::string line_type = "Continuous"; ///< or DASHED, DOT
};

/// Who extended data in our files is of; declared in each.
inline constexpr const char* dxf_application = "SPIA";

/// What a file is about, for its header.
struct DxfFrame {
    Eigen::Vector2d low, high; ///< in the unit of the file
    LengthUnit unit;
    std::vector<DxfLayer> layers; ///< but layer 0
    int next_handle;              ///< greater than all others
};

/// Of what stands in every file, and of the layers.
namespace dxf_handle {
enum : int {
    vports = 0x1,
    ltypes,
    layers,
    styles,
    views,
    ucss,
    appids,
    dimstyles,
    block_records,
    root_dictionary,
    group_dictionary,
    model_space,
    model_block,
    model_end,
    paper_space,
    paper_block,
    paper_end,
    by_block,
    by_layer,
    continuous,
    dashed,
    dotted,
    standard_style,
    standard_dimstyle,
    active,
    acad,
    own_application,
    layer_0,
    layer_outline,
    layer_holes,
    layer_bend_up,
    layer_bend_down,
    layer_bend_zone,
    layer_marks,
    layer_marks_text,
    first_entity = 0x100
};
}

/// Everything before the first entity; then come the entities, then end_dxf(). For .cpp files of
/// engine/exchange.
void begin_dxf(DxfText& dxf, const DxfFrame& frame);
void end_dxf(DxfText& dxf);

} // namespace spia
