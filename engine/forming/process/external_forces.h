#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace spia {

/// A force on the formed part's vertices that works against slip across a line: a drawbead or a
/// held edge.
struct Restraint {
    int vertex;
    Eigen::Vector3d across; ///< unit vector in the sheet, square to the line; its sign has no
                            ///< meaning
    double force;           ///< N
};

/// A vertex that a pin holds at a place of the blank.
struct HeldVertex {
    int vertex;
    Eigen::Vector2d place; ///< mm, in the blank
};

/// Slip on a tool that rests and is no plane, and on sheet that lay elsewhere than the part when it
/// slipped.
struct SlipOnFace {
    Eigen::Matrix2Xd foot; ///< 2 by #V, mm, in the blank: where the slip leads
    std::vector<Eigen::Matrix<double, 3, 2>>
        into_sheet; ///< per vertex: ways in the blank there to the part's tangent plane
};

/// What acts on the formed part from outside, all tangential to it, against the slip of the sheet
/// on the tool. Slip is a way in the plane of the blank: from where the material was, X, to where
/// it is seen along the stamping direction, or for a tool that travels to where it would be had it
/// stuck to the tool. The smallest turn of that plane into the sheet's tangent plane carries it
/// there, so the slip has no part of the stroke in it. A force fades out smoothly below
/// `full_slip`.
struct ExternalForces {
    Eigen::VectorXd traction;   ///< #F, MPa (N/mm2 of the part): friction on tools that rest; empty
                                ///< where there is none
    Eigen::VectorXd travelling; ///< likewise on tools that travel with the part: punch and pad
    Eigen::Matrix2Xd stuck;     ///< 2 by #V, mm: see stuck_places(); where something travels
    /// several of one vertex add up
    std::vector<Restraint> restraint;
    /// each vertex once
    std::vector<HeldVertex> held;
    /// axes of the blank in space
    Eigen::Matrix<double, 3, 2> plane = Eigen::Matrix<double, 3, 2>::Identity();
    double full_slip = 0.1;              ///< mm
    std::optional<SlipOnFace> slip = {}; ///< none: the plane of the blank is the tool's, as above

    bool any() const { return traction.size() > 0 || travelling.size() > 0 || !restraint.empty(); }
    /// A share of all forces; what is held stays held.
    ExternalForces scaled(double share) const;
};

/// A force in space and how it changes with the vertex's place on the blank.
struct ForceAtVertex {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();                              ///< N
    Eigen::Matrix<double, 3, 2> derivative = Eigen::Matrix<double, 3, 2>::Zero(); ///< N/mm
};

/// The forces of all vertices at once.
class NodalForces {
public:
    /// @param share  area of the part that belongs to each corner of each face is `area[f] / 3`
    NodalForces(const ExternalForces& forces, const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xd& normal,
                const Eigen::Matrix3Xi& triangle, const Eigen::VectorXd& area);

    bool acts_on(int vertex) const { return friction_.size() > 0 && acts_[size_t(vertex)]; }
    ForceAtVertex operator()(int vertex, const Eigen::Vector2d& X) const;

private:
    const ExternalForces& forces_;
    Eigen::Matrix2Xd below_; ///< the part seen along the stamping direction, or its feet on the
                             ///< tool
    std::vector<Eigen::Matrix<double, 3, 2>> into_sheet_; ///< per vertex: ways in the blank's plane
                                                          ///< to its tangent plane
    Eigen::VectorXd friction_, travelling_;               ///< N, per vertex; empty where nothing
                                                          ///< acts at all
    std::vector<std::vector<Restraint>> line_;            ///< by vertex
    std::vector<char> acts_;
};

} // namespace spia
