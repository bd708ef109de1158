#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>

namespace spia {

/// Coordinate systems of Nastran: rectangular, cylindrical and spherical, by three points that may
/// be given in other systems: all in one (CORD2R, CORD2C, CORD2S), or each in that of its node
/// (CORD1R, CORD1C, CORD1S).
class NastranSystems {
public:
    enum class Kind { rectangular, cylindrical, spherical };
    struct System {
        Kind kind;
        std::array<std::int64_t, 3> reference; ///< the systems in which its points are given; 0:
                                               ///< basic
        Eigen::Matrix3d points;                ///< columns: origin, a point on the third axis, one
                                               ///< in the plane of the first and third
    };
    void add(std::int64_t id, const System& system) { system_[id] = system; }

    /// Coordinates in the system (angles in degrees) as a point in space.
    /// Nothing if the system or one it refers to is not there, refers to itself, or has its points
    /// on a line.
    std::optional<Eigen::Vector3d> in_space(std::int64_t id, const Eigen::Vector3d& coordinates);

private:
    struct Frame {
        Kind kind;
        Eigen::Vector3d origin;
        Eigen::Matrix3d axes;
    };
    const std::optional<Frame>& frame(std::int64_t id);
    /// the systems that it refers to are known
    std::optional<Frame> frame_of(const System& system) const;
    std::map<std::int64_t, System> system_;
    std::map<std::int64_t, std::optional<Frame>> frame_;
};

} // namespace spia
