#include "engine/nurbs/anderson_mixing.h"

#include "engine/core/small_dense.h"

namespace spia {

Eigen::VectorXd AndersonMixing::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image)
{
    const Eigen::VectorXd change = image - x;
    if (change_.size() > 0) {
        change_step_.push_back(change - change_);
        image_step_.push_back(image - image_);
        if (change_step_.size() > depth_) {
            change_step_.pop_front();
            image_step_.pop_front();
        }
    }
    change_ = change;
    image_ = image;
    if (change_step_.empty())
        return image;
    Eigen::MatrixXd steps(x.size(), Eigen::Index(change_step_.size()));
    for (size_t k = 0; k < change_step_.size(); ++k)
        steps.col(Eigen::Index(k)) = change_step_[k];
    const Eigen::VectorXd factor = least_squares(steps, change);
    Eigen::VectorXd result = image;
    for (size_t k = 0; k < image_step_.size(); ++k)
        result -= factor[Eigen::Index(k)] * image_step_[k];
    return result;
}

void AndersonMixing::forget()
{
    change_step_.clear();
    image_step_.clear();
    change_.resize(0);
}

} // namespace spia
