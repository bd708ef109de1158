#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/length_unit.h"
#include "engine/core/progress.h"
#include "engine/exchange/lines/dxf_options.h"
#include "engine/exchange/mesh/write_gltf.h"
#include "engine/pipeline/session.h"

namespace spia {

/// Formats by the names the command line uses: the usual ones, those of isogeometric analysis
/// (iga_outputs.h), those of solver decks (deck_outputs.h).
const std::vector<std::string>& output_formats();
const std::vector<std::string>& usual_formats(); ///< what is written unless something else is asked
                                                 ///< for

/// Whether files of a format are of the surface or show something of it.
bool shows_surface(const std::string& format);
/// Whether files of a format are the surface itself, as NURBS: there is none without a surface.
bool is_of_surface(const std::string& format);

/// What a CSV export consists of; each is a file of its own.
struct CsvTables {
    bool fields = true, outline = true, faces = true;

    friend bool operator==(const CsvTables&, const CsvTables&) = default;
};

/// What the files hold, whatever their format.
struct OutputOptions {
    LengthUnit unit = LengthUnit::mm; ///< of IGES, STEP, isogeometric files, DXF, CSV and VTU; glTF
                                      ///< has metres by its specification, and what goes back to a
                                      ///< deck has its unit
    std::string name;                 ///< of the files, without folder and ending; empty: the
                                      ///< part's
    GltfNodes glb;
    CsvTables csv;
    DxfOptions dxf; ///< its unit is the one above

    friend bool operator==(const OutputOptions&, const OutputOptions&) = default;
};

/// Whether a file would hold the surface or its control net.
bool holds_surface(const std::string& format, const OutputOptions& options);

/// @throws InputError if a name that was asked for leads out of the folder or is none: it has a
/// path separator, say
void require_file_name(const std::string& name);

/// The files that write_outputs() would write now, in the order of `formats`: PART.iges, PART.step,
/// PART.glb, PART.vtu, PART.dxf, PART.png, and for csv the tables fields.csv, outline.csv and
/// faces.csv (with a name: NAME-fields.csv ...), iga_file_names() and deck_file_names(). IGES, STEP
/// and isogeometric files need a surface, a GLB file one of its nodes; without it they are left
/// out.
/// @throws InputError if a format is unknown, the name is none, or nothing is chosen of a CSV or
/// GLB file
std::vector<std::filesystem::path> output_files(const Session& session, const std::filesystem::path& folder,
                                                const std::vector<std::string>& formats,
                                                const OutputOptions& options = {});

/// Whether two paths lead to one place, also where nothing is yet.
bool same_place(const std::filesystem::path& a, const std::filesystem::path& b);

/// Finds out what would keep write_outputs() from writing, before the work that fills the files;
/// makes the folder.
/// @param others more files that the caller will write; empty paths do not count
/// @throws InputError as output_files(); ExchangeError if a place cannot be written, or a file
/// would take the place of
///         the part itself or of another output
void require_place(const Session& session, const std::filesystem::path& folder, const std::vector<std::string>& formats,
                   const std::vector<std::filesystem::path>& others = {}, const OutputOptions& options = {});

/// Writes the results of a session, solved at least, into a folder, which is made if need be:
/// output_files(). Each file appears whole or not at all. What has no surface yet leaves out of
/// each file what belongs to it.
/// @param formats some of output_formats()
/// @param progress cancelling takes effect before the next file is there
/// @param written called with each file that is there
/// @returns the files, in the order of `formats`
/// @throws InputError if the part is not solved, else as output_files(); ExchangeError if a file
/// cannot be written: the first of
///         them, when all others are there
std::vector<std::filesystem::path> write_outputs(const Session& session, const std::filesystem::path& folder,
                                                 const std::vector<std::string>& formats,
                                                 const OutputOptions& options = {}, const Progress& progress = {},
                                                 const WritingJob::Written& written = {});

} // namespace spia
