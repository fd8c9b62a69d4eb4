#pragma once

#include "materials/patterns/place_function.h"
#include "materials/patterns/place_program.h"

#include <filesystem>
#include <functional>
#include <map>

namespace lightwell {

/// Makes patterns, textures and mixtures of the words and numbers that scene text has for them. Files are read once,
/// however many patterns name them.
class PatternReader {
public:
    /// Where a file of that name is; nothing when there is none.
    using FindFile = std::function<std::optional<std::filesystem::path>(const std::string& name)>;
    /// The transform that the words from `begin` on stand for.
    using ReadTransform = std::function<Affine(const std::vector<std::string>& words, std::size_t begin)>;

    /// A picture that is read already, in the place of the one that the words name.
    struct GivenPicture {
        std::shared_ptr<const PictureTable> table;
        std::string file;     ///< where it is; empty: nowhere yet
        std::string contents; ///< the bytes of one that is nowhere yet
        std::string identity; ///< differs where pictures differ
    };

    struct Request {
        std::string type; ///< `colorfunc`, ...; mixtures without their two modifiers
        std::vector<std::string> words;
        std::vector<double> numbers;
        std::string place; ///< file, line and entity, for messages
        FindFile find_file;
        ReadTransform read_transform;
        std::shared_ptr<const GivenPicture> picture = nullptr; ///< null: the words name a file
    };
    /// @throws InputError with the place: words or numbers missing, files missing or damaged, functions that are not
    ///         defined
    std::shared_ptr<const PlaceFunction> read(const Request& request);
    static bool knows(std::string_view type) noexcept;
    /// The functions of a material, and the words among them that name other things.
    struct MaterialWords {
        std::shared_ptr<const PlaceProgram> functions;
        std::vector<std::string> names;             ///< of modifiers, as they stand
        std::optional<std::filesystem::path> table; ///< the file of measured scattering
    };
    /// @throws InputError as read() does
    MaterialWords read_material(const Request& request);
    static bool knows_material(std::string_view type) noexcept;

private:
    class Build;
    std::map<std::filesystem::path, std::shared_ptr<const std::string>> texts_;
    std::map<std::filesystem::path, std::shared_ptr<const DataTable>> tables_;
    std::map<std::filesystem::path, std::shared_ptr<const PictureTable>> pictures_, stored_pictures_;
    std::map<std::filesystem::path, std::shared_ptr<const PolygonFont>> fonts_;
    std::map<std::string, std::shared_ptr<const Definitions>> definitions_; ///< by the function files named together
};

} // namespace lightwell
