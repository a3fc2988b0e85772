#version 450
// What WGSL has no words for: logical operators without a branch, classification of numbers, matrix functions.
layout(local_size_x = 2) in;
layout(std430, set = 0, binding = 0) readonly buffer A { float a[]; };
layout(std430, set = 0, binding = 1) buffer O { float o[]; };

void main() {
    float x = a[0];
    float y = a[1];
    bool both = x > 0.0 && y > 3.0;
    bool either = x > 0.0 || y > 3.0;
    mat2 product = outerProduct(vec2(x, 3.0), vec2(y, 5.0));
    mat2 two = inverse(mat2(x, 1.0, 1.0, y));
    mat3 three = inverse(mat3(x, 0.0, 0.0, 0.0, y, 0.0, 1.0, 0.0, 4.0));
    mat4 four = inverse(mat4(x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 1.0, 0.0, 1.0));
    if (gl_LocalInvocationIndex == 0u) {
        o[0] = both ? 1.0 : 0.0;
        o[1] = either ? 1.0 : 0.0;
        o[2] = product[1][0];
        o[3] = two[0][0];
        o[4] = three[2][0];
        o[5] = four[3][1];
        o[6] = isnan(x) ? 1.0 : 0.0;
        o[7] = isinf(y) ? 1.0 : 0.0;
        o[8] = float(gl_WorkGroupSize.x);
    }
}
