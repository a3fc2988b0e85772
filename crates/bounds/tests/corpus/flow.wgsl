// Control flow: loops of every form, switches, early returns, nested calls.
@group(0) @binding(0) var<storage, read> a: array<i32>;
@group(0) @binding(1) var<storage, read_write> o: array<i32>;

fn classify(x: i32) -> i32 {
    switch x {
        case 0: { return 10; }
        case 1, 2: { return 20; }
        case -3: { if (x < 0) { break; } return 99; }
        default: { return 30; }
    }
    return 40;
}

fn unsigned(x: u32) -> i32 {
    var r = 0;
    switch x { case 0u, default: { r = 1; } case 5u: { r = 2; } }
    return r;
}

fn collatz(start: i32) -> i32 {
    var n = start;
    var steps = 0;
    loop {
        if (n == 1) { break; }
        if (n % 2 == 0) { n = n / 2; } else { n = 3 * n + 1; }
        continuing { steps++; }
    }
    return steps;
}

fn count_to(limit: i32) -> i32 {
    var k = 0;
    loop {
        continuing { k += 2; break if k >= limit; }
    }
    return k;
}

fn first_square_above(x: i32) -> i32 {
    for (var k = 0; ; k++) { if (k * k > x) { return k; } }
    return -1;
}

fn nested(n: i32) -> i32 {
    var sum = 0;
    for (var i = 0; i < n; i++) {
        if (i == 2) { continue; }
        var j = i;
        while (j > 0) {
            j--;
            if (j == 1) { continue; }
            sum += j;
            if (sum > 50) { break; }
        }
    }
    return sum;
}

@compute @workgroup_size(8)
fn main(@builtin(local_invocation_index) l: u32, @builtin(local_invocation_id) id: vec3u) {
    let x = a[l];
    o[l] = classify(x);
    o[8u + l] = unsigned(id.x);
    o[16u + l] = collatz(abs(x) + 1);
    o[24u + l] = count_to(x);
    o[32u + l] = first_square_above(x);
    o[40u + l] = nested(x);
}
