#pragma once
#include <vector>

namespace spia {

struct PartFile;

/// Whether numbers are those of faces and vertices of the file that have been replaced; CAD parts
/// have new ones.
bool numbered_as_read(const PartFile& part);

/// The vertices of the mesh that are called by a number of the file, in rising order; copies along
/// a seam are called the same. Of a remeshed part those nearest to where it was, of a vertex on the
/// boundary one on the boundary, of the copies along a seam one on each bank. Numbers beyond those
/// of the file are the remeshed part's own, see number_of(). Empty: there is no such number.
std::vector<int> vertices_called(const PartFile& part, int number);

/// What to call a vertex of the mesh so that vertices_called() leads back to it: its number in the
/// file. A remeshed part has vertices between those of the file; they have numbers beyond them,
/// which hold for this part alone, remeshed in this way.
int number_of(const PartFile& part, int vertex);

/// The number that the vertex nearest to this one had when the part was read: what is done before a
/// part is remeshed (a seam) goes by these.
int number_as_read(const PartFile& part, int vertex);

} // namespace spia
