#include "engine/exchange/write_dxf.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/error.h"
#include "engine/exchange/atomic_file.h"

namespace spia {
namespace {

/// A DXF file is a row of group codes and values, two lines each. Objects name each other by handles; those of the
/// fixed objects are below 0x100.
class DxfText {
public:
    DxfText& operator()(int code, const char* value) { return line(code, value); }
    DxfText& operator()(int code, int value) { return line(code, value); }
    DxfText& operator()(int code, double value) { return line(code, fmt::format("{:#.17g}", value)); }
    DxfText& point(int code, const Eigen::Vector2d& p) { return (*this)(code, p.x())(code + 10, p.y()); }
    DxfText& handle(int code, int value) { return line(code, fmt::format("{:X}", value)); }

    void begin_section(const char* name) { (*this)(0, "SECTION")(2, name); }
    void end_section() { (*this)(0, "ENDSEC"); }

    void begin_table(const char* name, int table, int entries)
    {
        (*this)(0, "TABLE")(2, name).handle(5, table).handle(330, 0)(100, "AcDbSymbolTable")(70, entries);
    }
    DxfText& entry(const char* type, const char* subclass, int own, int table, const char* name, int flags = 0)
    {
        (*this)(0, type).handle(5, own).handle(330, table)(100, "AcDbSymbolTableRecord")(100, subclass)(2, name);
        return (*this)(70, flags);
    }
    void end_table() { (*this)(0, "ENDTAB"); }

    const std::string& text() const { return text_; }

private:
    template <class Value> DxfText& line(int code, const Value& value)
    {
        fmt::format_to(std::back_inserter(text_), "{:3}\n{}\n", code, value);
        return *this;
    }
    std::string text_;
};

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
    root_dictionary = 0x10,
    group_dictionary,
    model_space = 0x20,
    model_block,
    model_end,
    paper_space,
    paper_block,
    paper_end,
    by_block = 0x30,
    by_layer,
    continuous,
    layer_0,
    layer_outline,
    layer_holes,
    standard_style,
    acad,
    standard_dimstyle,
    active,
    layer_bends,
    first_entity = 0x100,
};

struct Extent {
    Eigen::Vector2d low, high;
};

Extent extent_of(const std::vector<OutlineLoop>& loops)
{
    Extent extent{loops[0].rowwise().minCoeff(), loops[0].rowwise().maxCoeff()};
    for (const OutlineLoop& loop : loops) {
        extent.low = extent.low.cwiseMin(loop.rowwise().minCoeff());
        extent.high = extent.high.cwiseMax(loop.rowwise().maxCoeff());
    }
    return extent;
}

/// As $INSUNITS counts.
int dxf_number(LengthUnit unit)
{
    switch (unit) {
    case LengthUnit::inch: return 1;
    case LengthUnit::mm: return 4;
    case LengthUnit::cm: return 5;
    case LengthUnit::m: return 6;
    }
    return 4;
}

void write_header(DxfText& dxf, const Extent& extent, int next_handle, LengthUnit unit)
{
    const int metric = unit != LengthUnit::inch;
    dxf.begin_section("HEADER");
    dxf(9, "$ACADVER")(1, "AC1015")(9, "$DWGCODEPAGE")(3, "ANSI_1252");
    dxf(9, "$INSUNITS")(70, dxf_number(unit))(9, "$MEASUREMENT")(70, metric);
    dxf(9, "$EXTMIN").point(10, extent.low)(30, 0.0)(9, "$EXTMAX").point(10, extent.high)(30, 0.0);
    dxf(9, "$HANDSEED").handle(5, next_handle);
    dxf.end_section();
}

void write_tables(DxfText& dxf, const Extent& extent, bool bends)
{
    dxf.begin_section("CLASSES");
    dxf.end_section();
    dxf.begin_section("TABLES");
    dxf.begin_table("VPORT", vports, 1);
    const Eigen::Vector2d centre = (extent.low + extent.high) / 2, size = extent.high - extent.low;
    dxf.entry("VPORT", "AcDbViewportTableRecord", active, vports, "*Active")
        .point(10, {0, 0})
        .point(11, {1, 1})
        .point(12, centre)(40, 1.1 * std::max(size.y(), size.x() / 1.5))(41, 1.5);
    dxf.end_table();
    dxf.begin_table("LTYPE", ltypes, 3);
    for (const auto& [own, name] : {std::pair{by_block, "ByBlock"}, {by_layer, "ByLayer"}, {continuous, "Continuous"}})
        dxf.entry("LTYPE", "AcDbLinetypeTableRecord", own, ltypes, name)(3, "")(72, 65)(73, 0)(40, 0.0);
    dxf.end_table();
    dxf.begin_table("LAYER", layers, bends ? 4 : 3);
    for (const auto& [own, name, colour] :
         {std::tuple{layer_0, "0", 7}, {layer_outline, "OUTLINE", 7}, {layer_holes, "HOLES", 1}})
        dxf.entry("LAYER", "AcDbLayerTableRecord", own, layers, name)(62, colour)(6, "Continuous");
    if (bends)
        dxf.entry("LAYER", "AcDbLayerTableRecord", layer_bends, layers, "BENDS")(62, 5)(6, "Continuous");
    dxf.end_table();
    dxf.begin_table("STYLE", styles, 1);
    dxf.entry("STYLE", "AcDbTextStyleTableRecord", standard_style, styles,
              "Standard")(40, 0.0)(41, 1.0)(50, 0.0)(71, 0)(42, 2.5)(3, "txt")(4, "");
    dxf.end_table();
    dxf.begin_table("VIEW", views, 0);
    dxf.end_table();
    dxf.begin_table("UCS", ucss, 0);
    dxf.end_table();
    dxf.begin_table("APPID", appids, 1);
    dxf.entry("APPID", "AcDbRegAppTableRecord", acad, appids, "ACAD");
    dxf.end_table();
    dxf.begin_table("DIMSTYLE", dimstyles, 1);
    dxf(100, "AcDbDimStyleTable");
    dxf(0, "DIMSTYLE").handle(105, standard_dimstyle).handle(330, dimstyles); // the one entry whose handle has code 105
    dxf(100, "AcDbSymbolTableRecord")(100, "AcDbDimStyleTableRecord")(2, "Standard")(70, 0);
    dxf.end_table();
    dxf.begin_table("BLOCK_RECORD", block_records, 2);
    for (const auto& [own, name] : {std::pair{model_space, "*Model_Space"}, {paper_space, "*Paper_Space"}})
        dxf(0, "BLOCK_RECORD")
            .handle(5, own)
            .handle(330, block_records)(100, "AcDbSymbolTableRecord")(100, "AcDbBlockTableRecord")(2, name);
    dxf.end_table();
    dxf.end_section();
}

void write_blocks(DxfText& dxf)
{
    dxf.begin_section("BLOCKS");
    for (const auto& [record, begin, end, name] : {std::tuple{model_space, model_block, model_end, "*Model_Space"},
                                                   {paper_space, paper_block, paper_end, "*Paper_Space"}}) {
        dxf(0, "BLOCK")
            .handle(5, begin)
            .handle(330, record)(100, "AcDbEntity")(8, "0")(100, "AcDbBlockBegin")(2, name)(70, 0);
        dxf.point(10, {0, 0})(30, 0.0)(3, name)(1, "");
        dxf(0, "ENDBLK").handle(5, end).handle(330, record)(100, "AcDbEntity")(8, "0")(100, "AcDbBlockEnd");
    }
    dxf.end_section();
}

void write_line(DxfText& dxf, int handle, const char* layer, const Eigen::Matrix2Xd& points, bool closed)
{
    dxf(0, "LWPOLYLINE").handle(5, handle).handle(330, model_space)(100, "AcDbEntity");
    dxf(8, layer)(100, "AcDbPolyline")(90, int(points.cols()))(70, int(closed));
    for (const auto point : points.colwise())
        dxf.point(10, point);
}

void write_entities(DxfText& dxf, const std::vector<OutlineLoop>& loops, const std::vector<SheetLine>& bends)
{
    dxf.begin_section("ENTITIES");
    int handle = first_entity;
    for (size_t i = 0; i < loops.size(); ++i)
        write_line(dxf, handle++, i == 0 ? "OUTLINE" : "HOLES", loops[i], true);
    for (const SheetLine& bend : bends)
        write_line(dxf, handle++, "BENDS", bend.point.topRows<2>(), bend.closed);
    dxf.end_section();
}

void write_objects(DxfText& dxf)
{
    dxf.begin_section("OBJECTS");
    dxf(0, "DICTIONARY")
        .handle(5, root_dictionary)
        .handle(330, 0)(100, "AcDbDictionary")(281, 1)(3, "ACAD_GROUP")
        .handle(350, group_dictionary);
    dxf(0, "DICTIONARY").handle(5, group_dictionary).handle(330, root_dictionary)(100, "AcDbDictionary")(281, 1);
    dxf.end_section();
}

} // namespace

void write_dxf(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops_mm, LengthUnit unit,
               std::span<const SheetLine> bends_mm)
{
    require_outline(loops_mm);
    std::vector<OutlineLoop> loops = loops_mm;
    for (OutlineLoop& loop : loops)
        loop /= millimetres(unit);
    std::vector<SheetLine> bends(bends_mm.begin(), bends_mm.end());
    for (SheetLine& bend : bends) {
        if (bend.point.cols() < 2 || !bend.point.allFinite())
            throw InputError(fmt::format("the line \"{}\" needs two finite points or more", bend.name));
        bend.point /= millimetres(unit);
    }
    const Extent extent = extent_of(loops);
    DxfText dxf;
    write_header(dxf, extent, first_entity + int(loops.size() + bends.size()), unit);
    write_tables(dxf, extent, !bends.empty());
    write_blocks(dxf);
    write_entities(dxf, loops, bends);
    write_objects(dxf);
    dxf(0, "EOF");
    write_atomically(path, dxf.text());
}

} // namespace spia
