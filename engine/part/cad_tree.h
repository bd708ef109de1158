#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spia {

/// What a CAD file calls one thing: an assembly, or a body, which holds faces.
struct CadItem {
    enum class Kind { assembly, solid, sheet_body, loose_faces };
    Kind kind = Kind::solid;
    std::string name = {}; ///< in the file; empty: none; of a product at several places that of the
                           ///< place, if they differ
    int number = 0;        ///< among the assemblies, or among the bodies, from 0 in the order of
                           ///< the file
    int parent = -1;       ///< index of the assembly that holds it; -1: none
    int faces = 0;         ///< in it and in what it holds
};
std::string_view name(CadItem::Kind kind);

/// Assemblies and bodies of a CAD file. Every face is in one body; a product that stands at two
/// places is two bodies.
struct CadTree {
    std::vector<CadItem> item; ///< assemblies before what they hold
    std::vector<int> body_of;  ///< per face of the file: the item that holds it

    bool within(int item, int holder) const; ///< whether it is the holder or somewhere in it
    int bodies() const;
};

/// "body:2" or "assembly:0", as chosen_faces() takes it.
std::string choice(const CadItem& item);

/// Numbers of the faces that are wanted, ascending: faces ("7", "10-19"), what choice() gives, and
/// names, in upper or lower case unless that makes them ambiguous; all faces if nothing is wanted.
/// @throws InputError there is no such thing, or there are several of the name; it lists what there
/// is
std::vector<int> chosen_faces(const CadTree& tree, std::span<const std::string> wanted);

/// "body:2      Hood                         31 faces, sheet body", those in an assembly further to
/// the right.
std::string describe(const CadTree& tree, int item);

/// One line for each item, as messages show it; of many the first ones.
std::string item_list(const CadTree& tree);

} // namespace spia
