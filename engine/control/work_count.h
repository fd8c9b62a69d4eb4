#pragma once

#include "engine/control/predict.h"

namespace lightwell {

/// Work that fills a time. Accuracy, samples and seed together repeat a run to the bit, however long it takes there.
struct WorkCount {
    double accuracy = 0;    ///< of ambient light; two digits
    int samples = 0;        ///< of each pixel or sensor
    double cpu_seconds = 0; ///< for the pilot runs and what they predict
    Prediction prediction;
};

/// @param cpu_seconds  of all threads, pilot runs included; at least the coarsest result is made, whatever it takes
/// Error: at most twice the time; down to a tenth of it where ambient light turns out cheaper than the pilot runs told
/// (tests/cli/wishes_test.py)
/// @throws as predict()
WorkCount work_within(double cpu_seconds, const Simulation& simulation, const SensorGrid& grid,
                      const GridSettings& settings, const Progress& progress = {});
WorkCount work_within(double cpu_seconds, const Simulation& simulation, const View& view,
                      const PictureSettings& settings, const Progress& progress = {});

/// The work for a time when the pilot runs are known.
/// @param items  sensors or pixels
WorkCount work_of(const Prediction& prediction, double items, double cpu_seconds);

} // namespace lightwell
