#pragma once

#include "engine/scene/view.h"
#include "plugins/commands/radiance_settings.h"

namespace lightwell::commands {

/// A view and the size of its picture, from the words that `rpict` and `vwrays` share.
struct ViewOptions {
    std::string words; ///< as parse_view() takes them
    int columns = 512, rows = 512;
    double pixel_aspect = 1; ///< 0: whatever the sizes give

    /// Reads one of `-v... -x -y -pa -pd`; false for another option.
    bool read(OptionReader& words);
    /// @throws Fatal for a view that cannot be looked along
    View view() const;
    /// Makes one of the sizes smaller, so that pixels have the wanted shape.
    void fit(const View& view);
};

} // namespace lightwell::commands
