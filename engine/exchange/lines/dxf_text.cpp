#include "engine/exchange/lines/dxf_text.h"

#include <algorithm>
#include <tuple>

namespace spia {
namespace {

using namespace dxf_handle;

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

void write_header(DxfText& dxf, const DxfFrame& frame)
{
    const int metric = frame.unit != LengthUnit::inch;
    dxf.begin_section("HEADER");
    dxf(9, "$ACADVER")(1, dxf.r12() ? "AC1009" : "AC1015")(9, "$DWGCODEPAGE")(3, "ANSI_1252");
    dxf(9, "$INSUNITS")(70, dxf_number(frame.unit))(9, "$MEASUREMENT")(70, metric);
    dxf(9, "$EXTMIN").point(10, frame.low)(30, 0.0)(9, "$EXTMAX").point(10, frame.high)(30, 0.0);
    constexpr double usual = 300; // mm, of a drawing on which dashes of 4 mm are right
    dxf(9, "$LTSCALE")(40, (frame.high - frame.low).norm() * millimetres(frame.unit) / usual);
    if (dxf.r12())
        dxf(9, "$HANDLING")(70, 1);
    dxf(9, "$HANDSEED").handle(5, frame.next_handle);
    dxf.end_section();
}

/// Dashes and gaps in mm, as drawings have them.
void write_line_types(DxfText& dxf, LengthUnit unit)
{
    const double dash = 4 / millimetres(unit), gap = 2 / millimetres(unit);
    dxf.begin_table("LTYPE", ltypes, dxf.r12() ? 3 : 5);
    for (const auto& [own, name] : {std::pair{by_block, "ByBlock"}, {by_layer, "ByLayer"}, {continuous, "Continuous"}})
        if (!dxf.r12() || own == continuous)
            dxf.entry("LTYPE", "AcDbLinetypeTableRecord", own, ltypes, name)(3, "")(72, 65)(73, 0)(40, 0.0);
    for (const auto& [own, name, drawn, about] :
         {std::tuple{dashed, "DASHED", dash, "__ __ __"}, {dotted, "DOT", 0., ". . . ."}}) {
        dxf.entry("LTYPE", "AcDbLinetypeTableRecord", own, ltypes, name)(3, about)(72, 65)(73, 2)(40, drawn + gap);
        for (const double length : {drawn, -gap}) {
            dxf(49, length);
            if (!dxf.r12())
                dxf(74, 0); // no text or shape in it
        }
    }
    dxf.end_table();
}

void write_layers(DxfText& dxf, const DxfFrame& frame)
{
    dxf.begin_table("LAYER", layers, 1 + int(frame.layers.size()));
    dxf.entry("LAYER", "AcDbLayerTableRecord", layer_0, layers, "0")(62, 7)(6, "Continuous");
    for (const DxfLayer& layer : frame.layers)
        dxf.entry("LAYER", "AcDbLayerTableRecord", layer.handle, layers, layer.name)(62, layer.colour)(6,
                                                                                                       layer.line_type);
    dxf.end_table();
}

void write_styles(DxfText& dxf)
{
    dxf.begin_table("STYLE", styles, 1);
    dxf.entry("STYLE", "AcDbTextStyleTableRecord", standard_style, styles,
              "Standard")(40, 0.0)(41, 1.0)(50, 0.0)(71, 0)(42, 2.5)(3, "txt")(4, "");
    dxf.end_table();
}

void write_applications(DxfText& dxf)
{
    dxf.begin_table("APPID", appids, 2);
    dxf.entry("APPID", "AcDbRegAppTableRecord", acad, appids, "ACAD");
    dxf.entry("APPID", "AcDbRegAppTableRecord", own_application, appids, dxf_application);
    dxf.end_table();
}

void write_tables_r12(DxfText& dxf, const DxfFrame& frame)
{
    dxf.begin_section("TABLES");
    write_line_types(dxf, frame.unit);
    write_layers(dxf, frame);
    write_styles(dxf);
    write_applications(dxf);
    dxf.end_section();
}

void write_tables(DxfText& dxf, const DxfFrame& frame)
{
    if (dxf.r12())
        return write_tables_r12(dxf, frame);
    dxf.begin_section("CLASSES");
    dxf.end_section();
    dxf.begin_section("TABLES");
    dxf.begin_table("VPORT", vports, 1);
    const Eigen::Vector2d centre = (frame.low + frame.high) / 2, size = frame.high - frame.low;
    dxf.entry("VPORT", "AcDbViewportTableRecord", active, vports, "*Active")
        .point(10, {0, 0})
        .point(11, {1, 1})
        .point(12, centre)(40, 1.1 * std::max(size.y(), size.x() / 1.5))(41, 1.5);
    dxf.end_table();
    write_line_types(dxf, frame.unit);
    write_layers(dxf, frame);
    write_styles(dxf);
    dxf.begin_table("VIEW", views, 0);
    dxf.end_table();
    dxf.begin_table("UCS", ucss, 0);
    dxf.end_table();
    write_applications(dxf);
    dxf.begin_table("DIMSTYLE", dimstyles, 1);
    dxf(100, "AcDbDimStyleTable");
    // the one entry whose handle has code 105
    dxf(0, "DIMSTYLE").handle(105, standard_dimstyle).handle(330, dimstyles);
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
    if (dxf.r12())
        return;
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

void write_objects(DxfText& dxf)
{
    if (dxf.r12())
        return;
    dxf.begin_section("OBJECTS");
    dxf(0, "DICTIONARY")
        .handle(5, root_dictionary)
        .handle(330, 0)(100, "AcDbDictionary")(281, 1)(3, "ACAD_GROUP")
        .handle(350, group_dictionary);
    dxf(0, "DICTIONARY").handle(5, group_dictionary).handle(330, root_dictionary)(100, "AcDbDictionary")(281, 1);
    dxf.end_section();
}

} // namespace

void begin_dxf(DxfText& dxf, const DxfFrame& frame)
{
    write_header(dxf, frame);
    write_tables(dxf, frame);
    write_blocks(dxf);
    dxf.begin_section("ENTITIES");
}

void end_dxf(DxfText& dxf)
{
    dxf.end_section();
    write_objects(dxf);
    dxf(0, "EOF");
}

} // namespace spia
