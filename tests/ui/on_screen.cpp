#include "tests/ui/on_screen.h"

#include <string>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/picking/camera.h"

namespace spia::viewer {
namespace {

const Json& picture_of(const Json& report, View view)
{
    return report.at("window").at("views").at(std::string(name(view)));
}

} // namespace

glm::dvec2 in_view(const Json& report, View view, double x, double y)
{
    const Json& picture = picture_of(report, view);
    return {picture["at"][0].get<double>() + x * picture["size"][0].get<double>(),
            picture["at"][1].get<double>() + y * picture["size"][1].get<double>()};
}

glm::dvec2 on_screen(const Json& report, View view, const Eigen::Vector3d& place)
{
    Json action = report.at("view");
    action["do"] = "set_view";
    const ViewSettings settings = action_from_json(action).as<SetViewSettings>()->view;
    const Json& size = picture_of(report, view)["size"];
    return in_view(report, view, 0, 0) +
           glm::dvec2(pixel_of(settings.camera[size_t(view)], place, {size[0].get<double>(), size[1].get<double>()}));
}

} // namespace spia::viewer
