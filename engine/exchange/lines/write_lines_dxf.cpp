#include <algorithm>
#include <string>

#include "engine/core/atomic_file.h"
#include "engine/exchange/lines/dxf_text.h"
#include "engine/exchange/lines/write_lines.h"

namespace spia {
namespace {

using namespace dxf_handle;

void polyline(DxfText& dxf, int handle, const std::string& layer, const Eigen::Matrix2Xd& points, bool closed)
{
    dxf(0, "LWPOLYLINE").handle(5, handle).handle(330, model_space)(100, "AcDbEntity");
    dxf(8, layer)(100, "AcDbPolyline")(90, int(points.cols()))(70, int(closed));
    for (const auto point : points.colwise())
        dxf.point(10, point);
}

/// @returns the next free handle
int polyline_in_space(DxfText& dxf, int handle, const std::string& layer, const Eigen::Matrix3Xd& points, bool closed)
{
    const int own = handle++;
    dxf(0, "POLYLINE").handle(5, own).handle(330, model_space)(100, "AcDbEntity");
    dxf(8, layer)(100, "AcDb3dPolyline")(66, 1).point(10, {0, 0})(30, 0.0)(70, 8 + int(closed));
    for (const auto point : points.colwise()) {
        dxf(0, "VERTEX").handle(5, handle++).handle(330, own)(100, "AcDbEntity")(8, layer)(100, "AcDbVertex");
        dxf(100, "AcDb3dPolylineVertex").point(10, point.head<2>())(30, point[2])(70, 32);
    }
    dxf(0, "SEQEND").handle(5, handle++).handle(330, own)(100, "AcDbEntity")(8, layer);
    return handle;
}

std::string layer_name(const std::string& name)
{
    std::string layer = name.empty() ? "0" : name;
    for (char& c : layer)
        if (c < ' ' || c > '~' || std::string("<>/\\\":;?*|,=`").find(c) != std::string::npos)
            c = '_';
    return layer;
}

} // namespace

void write_lines_dxf(const std::filesystem::path& path, std::span<const SheetLine> lines, LengthUnit unit)
{
    require_lines(lines);
    const double scale = 1 / millimetres(unit);
    bool flat = true;
    DxfFrame frame{lines[0].point.col(0).head<2>(), lines[0].point.col(0).head<2>(), unit, {}, 0};
    int handle = first_entity, points = 0;
    for (const SheetLine& line : lines) {
        frame.low = frame.low.cwiseMin(line.point.topRows<2>().rowwise().minCoeff());
        frame.high = frame.high.cwiseMax(line.point.topRows<2>().rowwise().maxCoeff());
        flat &= (line.point.row(2).array() == 0).all();
        points += int(line.point.cols()) + 2;
        const std::string name = layer_name(line.name);
        const bool known = name == "0" || std::any_of(frame.layers.begin(), frame.layers.end(),
                                                      [&](const DxfLayer& layer) { return layer.name == name; });
        if (!known)
            frame.layers.push_back({handle++, name, 7});
    }
    frame.low *= scale;
    frame.high *= scale;
    frame.next_handle = handle + points;
    DxfText dxf;
    begin_dxf(dxf, frame);
    for (const SheetLine& line : lines)
        if (flat)
            polyline(dxf, handle++, layer_name(line.name), line.point.topRows<2>() * scale, line.closed);
        else
            handle = polyline_in_space(dxf, handle, layer_name(line.name), line.point * scale, line.closed);
    end_dxf(dxf);
    write_atomically(path, dxf.text());
}

} // namespace spia
