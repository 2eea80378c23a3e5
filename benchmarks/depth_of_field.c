// Depth of field in C, sampler and scene fused: the baseline for benchmarks/depth_of_field.py.
// The same arithmetic as samplekit's kernels, free to be reordered: gcc -O3 -march=native -ffast-math.
#include <math.h>
#include <stdint.h>

static inline uint64_t mix64(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static inline uint64_t dimension_key(uint64_t key, uint64_t d) { return mix64(key ^ ((d + 1) * 0xD1342543DE82EF95u)); }

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

// disk: cx, cy, radius squared, value; ring: inner and outer radius squared.
typedef struct { double x, y, squared, value; } Disk;
typedef struct {
    Disk a, b, c;
    double ring_x, ring_y, inner, outer, ring, first, per_cell, cells, even, odd, beyond, front_coc, ring_coc, wall_coc;
} Layers;

static inline double over(double shown, Disk disk, double x, double y) {
    double dx = x - disk.x, dy = y - disk.y;
    return dx * dx + dy * dy < disk.squared ? disk.value : shown;
}

static inline double value(double x, double y, double u, double v, Layers l) {
    double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    int along_x = fabs(a) > fabs(b);
    double radius = along_x ? a : b, other = along_x ? b : a;
    double t = other / (radius != 0.0 ? radius : 1.0), z = t * t;
    double c = 1.1366971022815318e-10;
    c = c * z - 2.460955587619866e-08;
    c = c * z + 3.5908592407849206e-06;
    c = c * z - 0.0003259918865200662;
    c = c * z + 0.015854344243752184;
    c = c * z - 0.30842513753403916;
    c = (c * z + 1.0) * radius;
    double s = 6.8686480919622015e-12;
    s = s * z - 1.7571217394581216e-09;
    s = s * z + 3.1336158709086883e-07;
    s = s * z - 3.6576204137613535e-05;
    s = s * z + 0.002490394570182618;
    s = s * z - 0.08074551218827976;
    s = (s * z + 0.7853981633974483) * t * radius;
    double lx = along_x ? c : s, ly = along_x ? s : c;
    double column = floor((x + l.wall_coc * lx - l.first) * l.per_cell);
    double row = floor((y + l.wall_coc * ly - l.first) * l.per_cell);
    double half = 0.5 * (column + row);
    double shown = half == floor(half) ? l.even : l.odd;
    shown = (column >= 0.0) & (column < l.cells) & (row >= 0.0) & (row < l.cells) ? shown : l.beyond;
    double dx = x + l.ring_coc * lx - l.ring_x, dy = y + l.ring_coc * ly - l.ring_y, squared = dx * dx + dy * dy;
    shown = (squared >= l.inner) & (squared < l.outer) ? l.ring : shown;
    x += l.front_coc * lx, y += l.front_coc * ly;
    return over(over(over(shown, l.a, x, y), l.b, x, y), l.c, x, y);
}

static Disk disk_of(const double *f) { return (Disk){f[0], f[1], f[2] * f[2], f[3]}; }

void depth_of_field(double *image, long width, long height, long count, uint64_t seed, const uint32_t *table,
                    const double *front, const double *ring, const double *wall, const double *confusion) {
    const Layers l = {disk_of(front), disk_of(front + 4), disk_of(front + 8), ring[0], ring[1], ring[2] * ring[2],
                      ring[3] * ring[3], ring[4], wall[0], 1.0 / wall[1], wall[2], wall[3], wall[4], wall[5],
                      confusion[0], confusion[1], confusion[2]};
    const uint32_t *second = table + count, *third = second + count, *fourth = third + count;
    for (long j = 0; j < height; j++) {
        double top = (double)j / height, h = (double)(j + 1) / height - top;
        for (long i = 0; i < width; i++) {
            double left = (double)i / width, w = (double)(i + 1) / width - left;
            uint64_t key = mix64(((uint64_t)i | (uint64_t)j << 32) ^ mix64(seed ^ 0x9E3779B97F4A7C15u));
            uint32_t addend[4], factor[4];
            double tail[4];
            for (int d = 0; d < 4; d++) {
                uint64_t k = mix64(dimension_key(key, d) ^ 0x510E527FADE682D1u);
                addend[d] = (uint32_t)k;
                factor[d] = (uint32_t)(k >> 32) | 1;
                tail[d] = (double)(mix64(k + 0x9B05688C2B3E6C1Fu) >> 43) * 0x1p-53;
            }
            double sum = 0.0;
            for (long n = 0; n < count; n++) {
                double x = left + w * scrambled(table[n], addend[0], factor[0], tail[0]);
                double y = top + h * scrambled(second[n], addend[1], factor[1], tail[1]);
                double u = scrambled(third[n], addend[2], factor[2], tail[2]);
                double v = scrambled(fourth[n], addend[3], factor[3], tail[3]);
                sum += value(x, y, u, v, l);
            }
            image[j * width + i] = sum / count;
        }
    }
}
