#pragma once

#include "engine/accel/ray_queries.h"
#include "plugins/cli/host_calls.h"
#include "plugins/serve/events.h"
#include "plugins/serve/faces.h"

#include <memory>
#include <optional>

namespace lightwell::serve {

/// How much work a host wants for a grid.
GridSettings grid_settings_of(const Request& request);

/// The scene that a host works on, and what is done with it; one request at a time.
class Session {
public:
    /// Answers a request by events; all but cancel and quit.
    /// @throws InputError, Cancelled
    void run(const Request& request, Told& told);

private:
    /// A scene as it was read, and made ready for light.
    struct Loaded {
        std::optional<Simulation> simulation;
        SceneOrigins origins;
        Report report;
        std::map<std::string, std::string> provenance;
        std::vector<View> views;
        std::vector<SensorGrid> grids;
        std::vector<std::string> layers;
        std::optional<RayQueries> rays; ///< made when a picture shows layers
    };
    /// A picture for Blender: the name of its channels, and which layer each pixel shows.
    struct HostLayer {
        std::string name;
        std::vector<float> indices;
    };
    /// What did not have to be made again.
    struct Kept {
        std::size_t mesh_files = 0, read_files = 0;
        bool light = false; ///< ray queries, list of sources
    };

    void load(const Request& request, Told& told);
    void edit(const Request& request, Told& told);
    void plan(const Request& request, Told& told);
    void render(const Request& request, Told& told);
    void illuminance(const Request& request, Told& told);
    void surfaces(const Request& request, Told& told);

    Kept read_scene(Told& told);
    Scene read_files(Loaded& fresh);
    bool same_light(const Scene& scene, const Loaded& fresh) const;
    void tell_scene(Told& told, const Kept* kept);
    const Simulation& simulation() const;
    const Simulation& lit_simulation() const;
    View view_of(const std::string& text) const;
    SensorGrid grid_of(const std::string& text) const;
    PictureJob picture_job(const Request& request) const;
    std::vector<float> layer_indices_of(const PictureJob& job, Told& told);
    PictureResult render_progressively(PictureJob& job, const std::optional<HostLayer>& layer, Told& told) const;
    void write_picture(const PictureJob& job, const std::optional<HostLayer>& layer, PictureResult& result) const;

    std::filesystem::path file_, map_;
    KeptMeshes meshes_;
    std::optional<Loaded> loaded_;
};

} // namespace lightwell::serve
