// lightwell-import-assimp FORMAT FILE SECONDS BYTES: reads one file under limits of processor time and memory, and
// writes what it found to descriptor 3. Lightwell starts it; it is of no use by hand.

#include "importers/assimp/collect_scene.h"

#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace {

constexpr int answer_descriptor = 3;

void limit(int resource, unsigned long long value)
{
    const rlimit both{value, value};
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

bool write_all(const std::string& bytes)
{
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(answer_descriptor, bytes.data() + done, bytes.size() - done);
        if (count <= 0)
            return false;
        done += static_cast<std::size_t>(count);
    }
    return true;
}

std::string answer(const std::string& format, const std::string& file)
{
    try {
        return lightwell::scene_to_bytes(lightwell::collect_scene(file, format));
    } catch (const std::bad_alloc&) {
        return lightwell::refusal_to_bytes("it asks for more memory than a file of its size may take");
    } catch (const std::exception& error) {
        return lightwell::refusal_to_bytes(error.what());
    }
}

} // namespace

int main(int count, char** words)
{
    constexpr int wrong_usage = 2;
    if (count != 5)
        return wrong_usage;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, std::strtoull(words[3], nullptr, 10));
    limit(RLIMIT_DATA, std::strtoull(words[4], nullptr, 10));
    // Without the destructors of a scene that may be damaged.
    _exit(write_all(answer(words[1], words[2])) ? 0 : 1);
}
