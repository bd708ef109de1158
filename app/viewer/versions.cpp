#include "app/viewer/versions.h"

#include <Eigen/Core>
#include <GLFW/glfw3.h>
#include <OpenMesh/Core/System/config.h>
#include <fmt/core.h>
#include <gif_lib.h>
#include <glm/glm.hpp>
#include <imgui.h>
#include <nlohmann/json.hpp>
#include <tbb/version.h>

#include "app/viewer/render/graphics_card.h"
#include "engine/exchange/cad/cad_kernel_version.h"
#include "engine/sparse/sparse_version.h"

namespace spia::viewer {

std::vector<std::pair<std::string, std::string>> versions()
{
    const GraphicsCard card = graphics_card();
    const std::string glfw = glfwGetVersionString(); // behind the version stands how it was built
    return {{"SPIA", SPIA_VERSION},
            {"Graphics", card.renderer},
            {"OpenGL", card.opengl},
            {"GLFW", glfw.substr(0, glfw.find(' '))},
            {"Dear ImGui", ImGui::GetVersion()},
            {"OpenCASCADE", cad_kernel_version()},
            {"SuiteSparse", suitesparse_version()},
            {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
            {"OpenMesh", fmt::format("{}.{}", OM_GET_VER, OM_GET_MAJ)},
            {"oneTBB", TBB_VERSION_STRING},
            {"GLM", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
            {"JSON for Modern C++", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                                NLOHMANN_JSON_VERSION_PATCH)},
            {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
            {"GIFLIB", fmt::format("{}.{}.{}", GIFLIB_MAJOR, GIFLIB_MINOR, GIFLIB_RELEASE)}};
}

} // namespace spia::viewer
