#pragma once
#include <Eigen/Core>
#include <deque>

namespace spia {

/// Speeds up an iteration x -> g(x) that creeps towards its fixed point: next() is the combination
/// of the last images, their factors with the sum 1, whose changes g(x) - x cancel best. [Anderson
/// 1965; Walker and Ni 2011, eq. 2.1]
class AndersonMixing {
public:
    /// @param depth  how many steps back are combined
    explicit AndersonMixing(int depth) : depth_(size_t(depth)) {}

    /// @param image  g(x)
    Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image);

    /// Another g, or one that was not as smooth as it takes: the next step starts anew.
    void forget();

private:
    size_t depth_;
    std::deque<Eigen::VectorXd> change_step_, image_step_; ///< from one x to the next
    Eigen::VectorXd change_, image_;                       ///< the last; empty at first
};

} // namespace spia
