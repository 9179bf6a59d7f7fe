// Casts given rays with Embree, once for each order.
//
// Input, numbers separated by blanks:
//   polygons:   count, then for each the number of its corners and their coordinates
//   directions: count, then unit vectors in a source's frame
//   sources:    count, then for each its polygon, its origin, and its frame: tangent, bitangent, normal
//   orders:     "WIDTH ROBUST" each: rays per call (1, 8 or 16) and whether the scene is robust (0 or 1)
// Output: Embree's version, then one line for each order: CPU seconds, hits, hits on the source's own polygon.

#if !__has_include(<embree3/rtcore.h>)
#error "Embree 3 is not installed"
#endif
#include <embree3/rtcore.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <ctime>
#include <iostream>
#include <limits>
#include <vector>

namespace {

struct Vector { float x, y, z; };
struct Quad { unsigned corner[4]; };
struct Source { unsigned polygon; Vector origin, frame[3]; };

// Nearer hits are ignored, since coordinates are in single precision.
constexpr float NEAR = 1e-5f;

std::vector<Vector> corners;
std::vector<Quad> quads;
std::vector<unsigned> polygon_of_quad;
std::vector<Vector> directions;
std::vector<Source> sources;

std::istream &operator>>(std::istream &in, Vector &v) { return in >> v.x >> v.y >> v.z; }

size_t count() {
    size_t n = 0;
    std::cin >> n;
    return n;
}

void read() {
    const size_t polygons = count();
    for (unsigned polygon = 0; polygon < polygons; ++polygon) {
        const unsigned first = corners.size(), n = count();
        corners.resize(first + n);
        for (unsigned i = 0; i < n; ++i) std::cin >> corners[first + i];
        // A fan of quads; for Embree a quad with two equal last corners is a triangle.
        for (unsigned i = 1; i + 1 < n; i += 2) {
            const unsigned last = std::min(i + 2, n - 1);
            quads.push_back({{first, first + i, first + i + 1, first + last}});
            polygon_of_quad.push_back(polygon);
        }
    }
    directions.resize(count());
    for (auto &direction : directions) std::cin >> direction;
    sources.resize(count());
    for (auto &source : sources) {
        std::cin >> source.polygon >> source.origin;
        for (auto &axis : source.frame) std::cin >> axis;
    }
}

RTCScene build(RTCDevice device, bool robust) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto *vertices = static_cast<Vector *>(rtcSetNewGeometryBuffer(geometry,
        RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vector), corners.size()));
    std::copy(corners.begin(), corners.end(), vertices);
    auto *indices = static_cast<Quad *>(rtcSetNewGeometryBuffer(geometry,
        RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof(Quad), quads.size()));
    std::copy(quads.begin(), quads.end(), indices);
    rtcCommitGeometry(geometry);
    RTCScene scene = rtcNewScene(device);
    if (robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

struct Hits { size_t all = 0, own = 0; };

// One ray or a packet of rays; the types differ only in their names and in array or scalar members.
template <int N> struct Packet;
template <> struct Packet<8> {
    alignas(64) RTCRayHit8 rays;
    void cast(const int *valid, RTCScene scene, RTCIntersectContext &context) {
        rtcIntersect8(valid, scene, &context, &rays);
    }
};
template <> struct Packet<16> {
    alignas(64) RTCRayHit16 rays;
    void cast(const int *valid, RTCScene scene, RTCIntersectContext &context) {
        rtcIntersect16(valid, scene, &context, &rays);
    }
};

Vector turned(const Source &s, const Vector &d) {
    const auto &[t, b, n] = s.frame;
    return {t.x * d.x + b.x * d.y + n.x * d.z, t.y * d.x + b.y * d.y + n.y * d.z,
            t.z * d.x + b.z * d.y + n.z * d.z};
}

void score(unsigned quad, const Source &source, Hits &hits) {
    if (quad == RTC_INVALID_GEOMETRY_ID) return;
    ++hits.all;
    hits.own += polygon_of_quad[quad] == source.polygon;
}

template <int N> void shoot(RTCScene scene, const Source &source, Hits &hits) {
    Packet<N> packet;
    auto &[ray, hit] = packet.rays;
    alignas(64) int valid[N];
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t first = 0; first < directions.size(); first += N) {
        const int lanes = std::min<size_t>(N, directions.size() - first);
        for (int i = 0; i < N; ++i) {
            const Vector d = turned(source, directions[first + std::min(i, lanes - 1)]);
            valid[i] = i < lanes ? -1 : 0;
            ray.org_x[i] = source.origin.x, ray.org_y[i] = source.origin.y;
            ray.org_z[i] = source.origin.z, ray.tnear[i] = NEAR;
            ray.dir_x[i] = d.x, ray.dir_y[i] = d.y, ray.dir_z[i] = d.z;
            ray.time[i] = 0, ray.tfar[i] = std::numeric_limits<float>::infinity();
            ray.mask[i] = ~0u, ray.id[i] = 0, ray.flags[i] = 0;
            hit.primID[i] = hit.geomID[i] = hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        packet.cast(valid, scene, context);
        for (int i = 0; i < lanes; ++i) score(hit.primID[i], source, hits);
    }
}

template <> void shoot<1>(RTCScene scene, const Source &source, Hits &hits) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (const auto &direction : directions) {
        const Vector d = turned(source, direction);
        RTCRayHit one{};
        one.ray.org_x = source.origin.x, one.ray.org_y = source.origin.y;
        one.ray.org_z = source.origin.z, one.ray.tnear = NEAR;
        one.ray.dir_x = d.x, one.ray.dir_y = d.y, one.ray.dir_z = d.z;
        one.ray.tfar = std::numeric_limits<float>::infinity(), one.ray.mask = ~0u;
        one.hit.primID = one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &one);
        score(one.hit.primID, source, hits);
    }
}

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

}  // namespace

int main() {
    read();
#ifdef __SSE__
    // Flush denormals, as Embree's manual advises.
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
    RTCDevice device = rtcNewDevice("threads=1");
    const RTCScene scenes[] = {build(device, false), build(device, true)};
    const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
    std::cout << version / 10000 << '.' << version / 100 % 100 << '.' << version % 100 << std::endl;
    for (int width, robust; std::cin >> width >> robust;) {
        const auto cast = width == 1 ? shoot<1> : width == 8 ? shoot<8> : shoot<16>;
        Hits hits;
        const double start = cpu_seconds();
        for (const auto &source : sources) cast(scenes[robust != 0], source, hits);
        std::cout << cpu_seconds() - start << ' ' << hits.all << ' ' << hits.own << std::endl;
    }
}
