// The rendering core in C, sampler and scene fused: the baseline for benchmarks/core.py.
// The same arithmetic as samplekit's kernels, free to be reordered: gcc -O3 -march=native -ffast-math.
#include <math.h>
#include <stdint.h>

static inline uint64_t mix64(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static inline uint64_t dimension_key(uint64_t key, uint64_t d) { return mix64(key ^ ((d + 1) * 0xD1342543DE82EF95u)); }

static inline double uniform(uint64_t key, uint64_t second, uint64_t i) {
    uint64_t x = (i + 1) * 0x9E3779B97F4A7C15u + key;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x ^= second;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

static inline uint32_t reverse_bits(uint32_t x) {
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0F0F0F0Fu) | (x & 0x0F0F0F0Fu) << 4;
    return __builtin_bswap32(x);
}

static inline double scrambled(uint32_t x, uint32_t addend, uint32_t factor, double tail) {
    x ^= x * 0x3D20ADEAu;
    x += addend;
    x *= factor;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return (double)reverse_bits(x) * 0x1p-32 + tail;
}

static inline double disk(double x, double y) {
    double dx = x - 0.4523, dy = y - 0.5317;
    return dx * dx + dy * dy < 0.3 * 0.3 ? 1.0 : 0.0;
}

static inline double zoneplate(double x, double y) {
    double t = (x * x + y * y) * (1024.0 * 0.15915494309189535);
    t -= rint(t);
    double z = t * t, p = 0.0033613591661678065;
    p = p * z - 0.036140200239387854;
    p = p * z + 0.2819258131119026;
    p = p * z - 1.7143742361330825;
    p = p * z + 7.903534197648212;
    p = p * z - 26.426256599757675;
    p = p * z + 60.24464136226881;
    p = p * z - 85.45681720640431;
    p = p * z + 64.93939402266396;
    p = p * z - 19.739208802178695;
    return 0.5 + 0.5 * (p * z + 1.0);
}

static inline uint64_t pixel_key(uint64_t x, uint64_t y, uint64_t seed) {
    return mix64((x | y << 32) ^ mix64(seed ^ 0x9E3779B97F4A7C15u));
}

#define RENDER(NAME, POINT, SETUP, VALUE)                                                                   \
    void NAME(double *image, long width, long height, long count, uint64_t seed, const uint32_t *table) {   \
        for (long j = 0; j < height; j++) {                                                                 \
            double top = (double)j / height, h = (double)(j + 1) / height - top;                            \
            for (long i = 0; i < width; i++) {                                                              \
                double left = (double)i / width, w = (double)(i + 1) / width - left;                        \
                uint64_t key = pixel_key(i, j, seed);                                                       \
                SETUP                                                                                       \
                double sum = 0.0;                                                                           \
                for (long s = 0; s < count; s++) {                                                          \
                    double u, v;                                                                            \
                    POINT                                                                                   \
                    sum += VALUE(left + u * w, top + v * h);                                                \
                }                                                                                           \
                image[j * width + i] = sum / count;                                                         \
            }                                                                                               \
        }                                                                                                   \
    }

#define RANDOM_SETUP                                                                       \
    uint64_t a = dimension_key(key, 0), b = dimension_key(key, 1);                         \
    uint64_t a2 = mix64(a + 0xA0761D6478BD642Fu), b2 = mix64(b + 0xA0761D6478BD642Fu);
#define RANDOM_POINT u = uniform(a, a2, s); v = uniform(b, b2, s);

#define OWEN_SETUP                                                                                          \
    uint64_t a = mix64(dimension_key(key, 0) ^ 0x510E527FADE682D1u);                                        \
    uint64_t b = mix64(dimension_key(key, 1) ^ 0x510E527FADE682D1u);                                        \
    uint32_t a_add = (uint32_t)a, b_add = (uint32_t)b;                                                      \
    uint32_t a_factor = (uint32_t)(a >> 32) | 1, b_factor = (uint32_t)(b >> 32) | 1;                        \
    double a_tail = (double)(mix64(a + 0x9B05688C2B3E6C1Fu) >> 43) * 0x1p-53;                               \
    double b_tail = (double)(mix64(b + 0x9B05688C2B3E6C1Fu) >> 43) * 0x1p-53;
#define OWEN_POINT                                         \
    u = scrambled(table[s], a_add, a_factor, a_tail);      \
    v = scrambled(table[count + s], b_add, b_factor, b_tail);

RENDER(random_disk, RANDOM_POINT, RANDOM_SETUP, disk)
RENDER(random_zoneplate, RANDOM_POINT, RANDOM_SETUP, zoneplate)
RENDER(owen_disk, OWEN_POINT, OWEN_SETUP, disk)
RENDER(owen_zoneplate, OWEN_POINT, OWEN_SETUP, zoneplate)
