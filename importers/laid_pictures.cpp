#include "importers/laid_pictures.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "engine/pictures/image_file.h"
#include "materials/patterns/pattern_reader.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

using Use = FileTexture::Use;

/// All pictures of a file together: 400 MB. Those beyond it count with their mean.
constexpr std::size_t most_pixels = 32u << 20;
/// Below this mean a channel is black, and stays it.
constexpr double black = 1e-6;

bool takes_colour(const Material& material, bool colours_panes)
{
    return std::holds_alternative<Plastic>(material) || std::holds_alternative<Metal>(material) ||
           std::holds_alternative<Trans>(material) || (colours_panes && std::holds_alternative<Glass>(material));
}

bool is_sound(const FileTexture& texture)
{
    const auto finite = [](double number) { return std::isfinite(number); };
    return std::all_of(texture.placement.to_picture.begin(), texture.placement.to_picture.end(), finite) &&
           std::all_of(texture.strength.begin(), texture.strength.end(), finite);
}

std::string three_digits(const Spectrum& s)
{
    const auto rounded = [](double value) { return shortest(std::round(1000 * value) / 1000); };
    return rounded(s.r) + " " + rounded(s.g) + " " + rounded(s.b);
}

/// Numbers of laid_picture.cal.
std::vector<double> numbers_of(const FileTexture& texture, const PictureTable& table)
{
    const auto& m = texture.placement.to_picture;
    const double shorter = std::min(table.width(), table.height());
    std::vector<double> numbers(m.begin(), m.end());
    for (const double number :
         {texture.placement.repeats ? 1.0 : 0.0, table.width() / shorter, table.height() / shorter})
        numbers.push_back(number);
    if (texture.use == Use::normal) {
        numbers.insert(numbers.end(), {texture.strength[0], texture.strength[1], 0});
        return numbers;
    }
    const Spectrum mean = from_rec709(texture.mean);
    for (int channel = 0; channel < 3; ++channel)
        numbers.push_back(mean[channel] > black ? 1 / mean[channel] : 0);
    return numbers;
}

} // namespace

void settle_pictures(std::vector<FileTexture>& textures, std::size_t first, const Material& material,
                     bool colours_panes, const std::string& place, Report& report)
{
    bool coloured = false, bent = false;
    for (std::size_t i = first; i < textures.size(); ++i) {
        FileTexture& texture = textures[i];
        if (texture.use == Use::normal) {
            texture.laid = !bent && texture.as_stored && is_sound(texture);
            bent = true;
            report.add(texture.laid ? Finding::converted : Finding::unsupported, place,
                       texture.what + (texture.laid
                                           ? " bends the normals of surfaces that have coordinates for it: "
                                             "highlights and light from lamps show it"
                                           : " is laid by coordinates that are not taken; the surface stays smooth"));
        } else if (texture.use == Use::colour) {
            texture.laid = !coloured && texture.as_stored && is_sound(texture) && takes_colour(material, colours_panes);
            coloured = true;
            const std::string mean = texture.what + ": its mean, " + three_digits(texture.mean) + ", ";
            report.add(texture.laid ? Finding::converted : Finding::approximated, place,
                       mean + (texture.laid ? "is the average; surfaces that have coordinates for it show the picture"
                                            : "stands for the whole picture"));
        }
    }
}

std::set<std::string> pictured_materials(const std::vector<FileTexture>& textures)
{
    std::set<std::string> names;
    for (const FileTexture& texture : textures)
        if (texture.laid)
            names.insert(texture.material);
    return names;
}

std::set<ModifierId> modifiers_with_coordinates(const Scene& scene)
{
    std::set<ModifierId> found;
    const auto visit = [&](const Part& part) {
        for (const Surface& surface : part.surfaces)
            if (surface.shape == Shape::mesh && !part.meshes[surface.index]->texture.empty())
                found.insert(surface.modifier);
        for (const Instance& instance : part.instances)
            for (const Binding& binding : instance.bindings)
                if (found.contains(binding.inherited))
                    found.insert(binding.actual);
    };
    std::for_each(scene.prototypes.begin(), scene.prototypes.end(), visit); // inner ones come first
    visit(scene.root);
    return found;
}

std::shared_ptr<const PictureTable> LaidPictures::table_of(const FileTexture& texture, const std::string& bytes,
                                                           const std::string& identity)
{
    const bool colours = texture.use == Use::colour;
    std::shared_ptr<const PictureTable>& known = known_[identity + (colours ? " colours" : " stored")];
    if (known)
        return known;
    auto table = std::make_shared<PictureTable>(PictureTable::of_image(read_image(bytes, texture.what), colours));
    pixels_ += static_cast<std::size_t>(table->width()) * static_cast<std::size_t>(table->height());
    if (pixels_ > most_pixels)
        throw InputError(texture.what,
                         "the pictures of the file have more than " + std::to_string(most_pixels) + " pixels together",
                         "make them smaller");
    return known = std::move(table);
}

Varying LaidPictures::laid(const FileTexture& texture)
{
    const bool colours = texture.use == Use::colour;
    std::string bytes = bytes_of(texture, texture.what);
    auto given = std::make_shared<PatternReader::GivenPicture>();
    given->identity = std::to_string(bytes.size()) + " " + std::to_string(std::hash<std::string>{}(bytes));
    given->table = table_of(texture, bytes, given->identity);
    if (texture.bytes || texture.length > 0)
        given->contents = std::move(bytes);
    else
        given->file = texture.file.string();
    PatternReader::Request request;
    request.type = colours ? "colorpict" : "texpict";
    request.words = colours ? std::vector<std::string>{"laid_r", "laid_g", "laid_b"}
                            : std::vector<std::string>{"bend_x", "bend_y", "bend_z"};
    request.words.insert(request.words.end(), {"picture", "laid_picture.cal", "right", "up"});
    request.numbers = numbers_of(texture, *given->table);
    request.place = texture.what;
    request.find_file = [](const std::string&) { return std::nullopt; };
    request.picture = std::move(given);
    return {colours ? Varying::Kind::pattern : Varying::Kind::texture, PatternReader().read(request), void_modifier,
            void_modifier};
}

std::vector<Varying> LaidPictures::on(const std::string& file_material)
{
    std::vector<Varying> found;
    for (const Use use : {Use::normal, Use::colour})
        for (const FileTexture& texture : imported_.file_textures) {
            if (!texture.laid || texture.use != use || texture.material != file_material)
                continue;
            try {
                found.push_back(laid(texture));
            } catch (const InputError& error) {
                imported_.report.add(Finding::ignored, "material \"" + file_material + '"',
                                     std::string("picture left out, its mean stands for it: ") + error.what());
            }
        }
    return found;
}

} // namespace lightwell
