#include "engine/forming/material/sheet.h"

namespace spia {

Sheet uniform_sheet(const MembraneLaw& law, double thickness, int faces)
{
    return {{law}, {}, Eigen::VectorXd::Constant(faces, thickness)};
}

} // namespace spia
