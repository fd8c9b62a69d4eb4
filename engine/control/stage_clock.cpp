#include "engine/control/stage_clock.h"

#include "engine/control/predict.h"

namespace lightwell {

StageClock::StageClock(const Progress& outer) : outer_(outer), last_(process_cpu_seconds()) {}

void StageClock::count()
{
    const double now = process_cpu_seconds();
    seconds_[stage_] += now - last_;
    last_ = now;
}

Progress StageClock::progress()
{
    Progress progress;
    progress.report = [this](const std::string& stage, double fraction) {
        if (stage_.empty())
            stage_ = stage; // what came before the first report belongs to it
        count();
        stage_ = stage;
        outer_.tell(stage, fraction);
    };
    progress.cancelled = outer_.cancelled;
    return progress;
}

void StageClock::stop()
{
    count();
}

double StageClock::seconds(const std::string& beginning) const
{
    double sum = 0;
    for (const auto& [stage, seconds] : seconds_)
        sum += stage.starts_with(beginning) ? seconds : 0;
    return sum;
}

double StageClock::total() const
{
    return seconds({});
}

} // namespace lightwell
