#include <chrono>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "engine/exchange/read_cad.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/sample_patches.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {

TEST(CadPanel, Probe)
{
    const ScratchFolder folder;
    for (const int n : {10, 30})
        for (const char* name : {"panel.igs", "panel.step"}) {
            write_panel(folder / name, n, 0.2);
            auto t = std::chrono::steady_clock::now();
            const PartFile part = examine_part(folder / name, {.seam = {.mode = SeamOptions::Mode::none}});
            const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
            double worst = 0;
            for (int v = 0; v < part.mesh.vertices(); ++v) {
                const Eigen::Vector3d p = part.mesh.position.col(v);
                worst = std::max(worst, std::abs(p.z() - panel_height(p.x(), p.y())));
            }
            fmt::print("{} {}: {:.1f} s, {} triangles, components {}, loops {}, tol {}, worst {}, area {}\n", name, n, s, part.mesh.triangles(), part.doctor.components, part.doctor.boundary_loops.value_or(-1), part.cad->sewing_tolerance, worst, area(part.mesh));
            for (auto& note : part.notes) fmt::print("  {}\n", note);
            for (auto& f : part.doctor.findings) fmt::print("  {} {}\n", int(f.severity), f.text);
        }
}

} // namespace spia
