#include "importers/gltf/gltf_pictures.h"

#include "engine/base/errors.h"
#include "engine/base/text.h"
#include "importers/gltf/gltf_buffers.h"

namespace lightwell {
namespace {

std::string place_of(const GltfDocument& document, int image)
{
    return document.name + ": image " + std::to_string(image);
}

/// A slice of the file itself where the bytes lie in it, else a copy.
FileTexture in_view(const GltfDocument& document, const GltfImage& image, const std::string& place)
{
    if (static_cast<std::size_t>(image.view) >= document.views.size())
        throw InputError(place, "refers to buffer view " + std::to_string(image.view) + " of " +
                                    std::to_string(document.views.size()));
    const GltfView& view = document.views[static_cast<std::size_t>(image.view)];
    if (!view.fault.empty() || view.bytes.empty())
        throw InputError(place, view.fault.empty() ? "has no bytes" : view.fault);
    FileTexture texture;
    const std::string_view whole = document.files[0]->bytes();
    const bool inside = std::less_equal<>()(whole.data(), view.bytes.data()) &&
                        std::less<>()(view.bytes.data(), whole.data() + whole.size());
    if (!inside) {
        texture.bytes = std::make_shared<const std::string>(view.bytes);
        return texture;
    }
    texture.file = document.file;
    texture.offset = static_cast<std::size_t>(view.bytes.data() - whole.data());
    texture.length = view.bytes.size();
    return texture;
}

} // namespace

FileTexture GltfPictures::located(int index) const
{
    const std::string place = place_of(document_, index);
    if (index < 0 || static_cast<std::size_t>(index) >= document_.images.size())
        throw InputError(place, "is not there");
    const GltfImage& image = document_.images[static_cast<std::size_t>(index)];
    FileTexture texture;
    if (image.uri.empty())
        return in_view(document_, image, place);
    if (image.uri.rfind("data:", 0) == 0) {
        texture.bytes = std::make_shared<const std::string>(data_uri_bytes(image.uri, place));
        return texture;
    }
    const auto file = companion_file(image.uri, document_.file.parent_path());
    if (!file)
        throw InputError(place, "its file \"" + to_utf8(image.uri.substr(0, 100)) + "\" is not there");
    texture.file = *file;
    return texture;
}

const PictureMeans* GltfPictures::means(int image, const std::string& place, Report& report)
{
    const auto [entry, fresh] = known_.try_emplace(image);
    if (fresh) {
        try {
            entry->second = picture_means(located(image), place_of(document_, image));
        } catch (const InputError& error) {
            report.add(Finding::ignored, place, std::string("picture left out: ") + error.what());
        }
    }
    return entry->second ? &*entry->second : nullptr;
}

} // namespace lightwell
