#include "engine/scene/surface.h"

namespace lightwell {
}
