#pragma once

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// Bytes of a PLY file, put together value by value.
class PlyWriter {
public:
    explicit PlyWriter(std::string header) : bytes_("ply\nformat binary_little_endian 1.0\n" + std::move(header)) {}
    PlyWriter& data()
    {
        bytes_ += "end_header\n";
        return *this;
    }
    template <class T>
    PlyWriter& put(T value)
    {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes_.append(raw, sizeof value);
        return *this;
    }
    template <class T>
    PlyWriter& all(const std::vector<T>& values)
    {
        for (const T value : values)
            put(value);
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Vertices in double and faces, with whatever the header adds to a face: `more` is called with its number.
struct PlyFaces {
    std::vector<double> points;
    std::vector<std::vector<int>> faces;
    std::string comments = {}, face_properties = {}, more_elements = {};

    template <class More>
    std::string bytes(const More& more) const
    {
        PlyWriter ply(comments + "element vertex " + std::to_string(points.size() / 3) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(faces.size()) + "\nproperty list uchar int vertex_indices\n" + face_properties +
                      more_elements);
        ply.data().all(points);
        for (std::size_t i = 0; i < faces.size(); ++i) {
            ply.put(static_cast<unsigned char>(faces[i].size())).all(faces[i]);
            more(ply, i);
        }
        return ply.bytes();
    }
    std::string bytes() const
    {
        return bytes([](PlyWriter&, std::size_t) {});
    }
};

} // namespace lightwell
