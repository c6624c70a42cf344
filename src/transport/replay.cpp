#include "transport/replay.h"

#include "camera_batch.h"
#include "path_trace.h"
#include "photon_maps.h"
#include "scene/match.h"

#include <string>

namespace nephroid {

bool can_replay(Integrator const& integrator) {
    return match(
        integrator, [](PathIntegrator const&) { return true; }, [](DirectIntegrator const&) { return true; },
        [](WhittedIntegrator const&) { return true; },
        // What they show is made by many paths from lights at once; nor do branches keep their numbers.
        [](PhotonMapIntegrator const&) { return false; }, [](SppmIntegrator const&) { return false; },
        [](LightPathIntegrator const&) { return false; });
}

PathRecord replay(RenderJob const& job, std::uint64_t pass, Vec2i pixel) {
    if (!can_replay(job.settings().integrator))
        throw Error(ErrorKind::Input,
                    "this integrator's light comes from many light paths at once and not along one path of a "
                    "pixel; replay with the integrator path, direct or whitted");
    Vec2i const size = job.settings().film.resolution;
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
        throw Error(ErrorKind::Input, "the picture has no pixel " + std::to_string(pixel.x) + "," +
                                          std::to_string(pixel.y) + "; x goes from 0 to " +
                                          std::to_string(size.x - 1) + ", y from 0 to " +
                                          std::to_string(size.y - 1));
    PathRecord record;
    record.pass = pass;
    record.pixel = pixel;
    PathTrace trace(record);
    Film film(size, {pixel.x, pixel.x + 1, pixel.y, pixel.y + 1}, false, {});
    RayStats stats;
    PassWork const none;
    CameraBatch batch(job, none, film, stats);
    batch.add(pixel.x, pixel.y, pass, pass);
    batch.run(&trace);
    return record;
}

}  // namespace nephroid
