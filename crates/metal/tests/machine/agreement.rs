//! What the library of MSL does, beside the evaluator on the same source: exact where the language is exact, a few roundings elsewhere.

use std::collections::BTreeMap;

use bossage_embedded::Embedded;
use bossage_runner::{
    Attribute, Blend, Clear, Cull, Depth, Draw, Machine, Mesh, RenderJob, RenderTarget, Resources, Shader,
    run_probe,
};

use crate::support::{bits, compile, device};

/// Numbers of all signs and sizes, whole ones among them.
const INPUTS: [f32; 16] = [
    0.0, -0.0, 1.0, -1.0, 0.5, -2.5, 3.0, -7.0, 10.75, 255.0, -128.0, 1000.25, 1e-6, -1e-3, 65504.0, 0.333,
];

fn kernel(outputs: usize, more: &str, body: &str) -> String {
    format!(
        "{more}
         @group(0) @binding(0) var<storage, read> inputs: array<f32>;
         @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
         fn put(id: u32, k: u32, value: f32) {{ outputs[id * {outputs}u + k] = value; }}
         @compute @workgroup_size(4) fn main(@builtin(global_invocation_id) g: vec3u, @builtin(local_invocation_index) l: u32) {{
            let id = g.x;
            let a = inputs[id * 4u];
            let b = inputs[id * 4u + 1u];
            let c = inputs[id * 4u + 2u];
            let d = inputs[id * 4u + 3u];
            {body}
         }}"
    )
}

/// The outputs of four invocations by MSL and by the evaluator.
fn both(outputs: usize, more: &str, body: &str) -> Option<[Vec<f32>; 2]> {
    let machine = device("agreement")?;
    let compiled = compile(&kernel(outputs, more, body));
    let run = |machine: &dyn Machine, shader: Shader<'_>| {
        run_probe(machine, shader.code, shader.entry, &INPUTS, outputs, 4)
            .unwrap_or_else(|e| panic!("{e}: {body}"))
    };
    Some([
        run(machine, compiled.msl("main")),
        run(&Embedded::new(), compiled.evaluated("main")),
    ])
}

fn exactly(outputs: usize, more: &str, body: &str) {
    if let Some([msl, evaluated]) = both(outputs, more, body) {
        assert_eq!(
            bits(&msl),
            bits(&evaluated),
            "{msl:?} against {evaluated:?}: {body}"
        );
    }
}

#[test]
fn vectors_of_integers_have_swizzles_and_wrap() {
    exactly(
        4,
        "",
        "let v = vec4i(vec4f(a, b, c, d)); let w = v.wzyx * v.xxyy + (v.zwzw ^ vec4i(5));
         let s = v.yz - v.xw; let t = -v.zyx % vec3i(3, 5, 7);
         put(id, 0u, f32(w.x + s.y)); put(id, 1u, f32(w.w - t.z)); put(id, 2u, f32((v << vec4u(2u)).y >> 1u)); put(id, 3u, f32(~t.x | s.x));",
    );
}

#[test]
fn truth_of_vectors_is_zero_or_one_as_a_number() {
    exactly(
        6,
        "",
        "let v = vec3f(a, b, c); let w = vec3f(d, 0.0, 1.0);
         let less = v < w; let f = vec3f(less); let u = vec3u(v >= w); let i = vec3i(v == w);
         put(id, 0u, f.x + 2.0 * f.y + 4.0 * f.z); put(id, 1u, f32(u.x + 2u * u.y + 4u * u.z)); put(id, 2u, f32(i.x + i.y - i.z));
         let m = select(v, w, !less | (v > vec3f(2.0))); put(id, 3u, m.x); put(id, 4u, m.y + m.z);
         put(id, 5u, f32(any(less)) + 2.0 * f32(all(less)) + 4.0 * f32(less.y) + 8.0 * f32(vec2i(v.xy) == vec2i(w.xy).yx).x);"
            .replace("8.0 * f32(vec2i(v.xy) == vec2i(w.xy).yx).x", "8.0 * vec2f(vec2i(v.xy) == vec2i(w.xy).yx).x")
            .as_str(),
    );
}

#[test]
fn bits_and_packing_are_exact() {
    exactly(
        8,
        "",
        "let u = bitcast<u32>(a); let i = i32(b);
         put(id, 0u, f32(countOneBits(u) + countLeadingZeros(u) * 64u + countTrailingZeros(u) * 4096u));
         put(id, 1u, f32(reverseBits(u) >> 9u)); put(id, 2u, f32(extractBits(i, 2u, 4u))); put(id, 3u, f32(extractBits(u, 3u, 7u)));
         put(id, 4u, f32(insertBits(u, 5u, 4u, 8u) >> 8u)); put(id, 5u, f32(firstLeadingBit(u)) + f32(firstTrailingBit(i)) * 64.0);
         let p = pack4x8snorm(vec4f(a, b, c, d)); let q = pack2x16unorm(vec2f(c, d)); let h = pack2x16float(vec2f(c, d));
         put(id, 6u, f32(p >> 8u) + f32(q >> 24u)); put(id, 7u, unpack2x16float(h).x + unpack2x16float(h).y + unpack4x8snorm(p).z + unpack2x16unorm(q).x);",
    );
}

#[test]
fn packed_vectors_and_matrices_lie_where_the_layout_says() {
    exactly(
        4,
        "struct Item { n: vec3f, w: f32, m: mat2x3f, last: vec3u, tail: u32 }
         var<private> item: Item; var<workgroup> items: array<Item, 4>;",
        "item = Item(vec3f(a, b, c), d, mat2x3f(vec3f(a, c, d), vec3f(b, b, a)), vec3u(1u, 2u, 3u), 4u);
         items[l] = item; workgroupBarrier(); let other = items[3u - l];
         let p = other.m * vec2f(0.5, -1.0); let q = vec3f(1.0, 0.5, 2.0) * other.m;
         put(id, 0u, other.n.z + other.w); put(id, 1u, p.x + p.y); put(id, 2u, q.y); put(id, 3u, f32(other.last.z + other.tail));",
    );
}

#[test]
fn atomics_and_barriers_count_everything_once() {
    exactly(
        3,
        "var<workgroup> sum: atomic<u32>; var<workgroup> least: atomic<i32>;",
        "if l == 0u { atomicStore(&least, 1000); }
         workgroupBarrier(); atomicAdd(&sum, l + 1u); atomicMin(&least, i32(b)); workgroupBarrier();
         let first = atomicLoad(&sum); workgroupBarrier(); atomicXor(&sum, 1u << l); workgroupBarrier();
         put(id, 0u, f32(first)); put(id, 1u, f32(atomicLoad(&sum))); put(id, 2u, f32(atomicLoad(&least)));",
    );
}

#[test]
fn half_precision_is_rounded_after_each_operation() {
    exactly(
        4,
        "enable f16;",
        "let x = f16(clamp(a, -100.0, 100.0)); let y = f16(clamp(b, -100.0, 100.0)); let v = vec3h(x, y, f16(0.1));
         put(id, 0u, f32(x * y + f16(0.3))); put(id, 1u, f32((v.zyx - v).x)); put(id, 2u, f32(select(x, y, x < y))); put(id, 3u, f32(x) * f32(v.z));",
    );
}

#[test]
fn a_swapped_component_is_seen() {
    let Some(machine) = device("agreement") else {
        return;
    };
    let compiled = compile(&kernel(1, "", "put(id, 0u, vec4f(a, b, c, d).x - 1.0);"));
    let good = compiled.msl("main");
    let swapped = compiled.msl["main"].replacen(").x", ").y", 1);
    assert_ne!(swapped, compiled.msl["main"]);
    let bad = Shader {
        code: bossage_runner::Code::Msl(&swapped),
        ..good
    };
    let run = |shader: Shader<'_>| run_probe(machine, shader.code, shader.entry, &INPUTS, 1, 4).unwrap();
    assert_ne!(run(good), run(bad));
}

const PICTURE: &str = "
    struct Varyings { @builtin(position) clip: vec4f, @location(0) uv: vec2f, @location(1) @interpolate(flat, either) kind: u32 }
    @vertex fn vs(@location(0) position: vec3f, @builtin(vertex_index) index: u32) -> Varyings {
        return Varyings(vec4f(position, 1.0 + 0.25 * position.x), position.xy * 1.5, index + 3u);
    }
    @fragment fn fs(in: Varyings, @builtin(front_facing) front: bool) -> @location(0) vec4f {
        let bent = in.uv * in.uv;
        let dx = dpdx(bent.x); let dy = dpdy(bent.y); let w = fwidth(in.uv.y);
        if (i32(in.clip.x) + i32(in.clip.y)) % 5 == 0 { discard; }
        return vec4f(dx, dy, w, select(-1.0, 1.0, front) * f32(in.kind) + in.clip.z);
    }";

#[test]
fn quads_have_the_derivatives_that_the_evaluator_gives_them() {
    let Some(machine) = device("quads") else { return };
    let compiled = compile(PICTURE);
    let corners: Vec<f32> = [[-0.9, -0.8, 0.1], [0.8, -0.7, 0.3], [0.1, 0.9, 0.6]].concat();
    let mesh = Mesh {
        attributes: BTreeMap::from([(
            "position".to_owned(),
            Attribute {
                components: 3,
                values: corners,
            },
        )]),
        indices: vec![0, 1, 2],
    };
    let picture = |machine: &dyn Machine, vertex, fragment| {
        let job = RenderJob {
            name: "quads",
            width: 33,
            height: 21,
            targets: vec![RenderTarget::floats(Clear::Sentinel)],
            read_depth: false,
            passes: vec![vec![Draw {
                vertex,
                fragment,
                mesh: &mesh,
                resources: Resources::default(),
                cull: Cull::None,
                blend: Blend::Replace,
                depth: Depth::TestAndWrite,
            }]],
        };
        job.run(machine).unwrap_or_else(|e| panic!("{e}")).targets[0].clone()
    };
    let msl = picture(machine, compiled.msl("vs"), compiled.msl("fs"));
    let evaluated = picture(
        &Embedded::new(),
        compiled.evaluated("vs"),
        compiled.evaluated("fs"),
    );
    assert_eq!(msl.covered(), evaluated.covered());
    assert!(msl.covered().iter().filter(|covered| **covered).count() > 100);
    assert_eq!(
        bits(msl.pixels.as_flattened()),
        bits(evaluated.pixels.as_flattened())
    );
}
