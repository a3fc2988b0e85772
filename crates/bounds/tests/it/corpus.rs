//! The corpus in the `f32` domain, against numbers worked out by hand or with Rust's own integers and floats.

use crate::common::{dispatch, dispatch_many, program, source};
use bossage_bounds::{
    Accept, Bindings, BufferData, Error, F32, Limits, Program, Scalar, Slot, StageInputs, run_compute,
    run_fragment, run_vertex,
};
use naga::back::PipelineConstants;

fn floats(list: &[f32]) -> Vec<u8> {
    list.iter().flat_map(|w| w.to_le_bytes()).collect()
}

fn values_bindings<D: bossage_bounds::Domain>() -> Bindings<D> {
    // mat4x4 with translation 10 in x; scale (0, 2); count 1; weights[1].z = 5.
    let mut uniform = vec![
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 2.0,
    ];
    uniform.push(f32::from_bits(1));
    uniform.push(0.0);
    uniform.extend([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 0.0]);
    Bindings::new()
        .floats(0, 0, &[1.0, 7.0])
        .floats(0, 1, &[0.0; 17])
        .bytes(0, 2, floats(&uniform))
        .bytes(0, 3, vec![0; 24 + 8 + 32 + 16])
        .immediate(floats(&[0.25]))
}

/// `m` is ((1,2,3),(4,5,9)) after the store.
const VALUES: [f64; 17] = [
    3.0 + 4.0,
    40.0,
    3.0 + 90.0,
    4.0 + 5.0 + 9.0,
    4.0 + 10.0 + 27.0,
    3.5 + 6.0,
    8.0 + 7.0,
    9.0 + 9.0 + 2.0,
    11.0 * 2.0 + 5.0,
    1.0,
    3.0 + 4.0,
    3.5,
    2.0 + 12.0,
    1.25,
    1.0,
    8.0 + 2.0 + 2.0 + 6.0,
    2.0 + 8.0,
];

#[test]
fn values() {
    let (b, _) = dispatch::<F32>(&source("values"), values_bindings());
    assert_eq!(b.read_floats(0, 1).unwrap(), VALUES);
    let (b, _) = dispatch::<Accept>(&source("values"), values_bindings());
    for (k, (x, want)) in b.read_floats(0, 1).unwrap().iter().zip(VALUES).enumerate() {
        assert!(
            x.contains(want) && !x.is_indeterminate(),
            "o[{k}] = {x:?}, want {want}"
        );
    }
}

fn collatz(mut n: i32) -> i32 {
    let mut steps = 0;
    while n != 1 {
        n = if n % 2 == 0 { n / 2 } else { 3 * n + 1 };
        steps += 1;
    }
    steps
}

fn nested(n: i32) -> i32 {
    let mut sum = 0;
    for i in (0..n).filter(|&i| i != 2) {
        for j in (0..i).rev().filter(|&j| j != 1) {
            sum += j;
            if sum > 50 {
                break;
            }
        }
    }
    sum
}

#[test]
fn flow() {
    let a = [0, 1, 2, -3, 7, 30, 12, -8];
    let input: Vec<u32> = a.iter().map(|&x: &i32| x as u32).collect();
    let b = Bindings::<F32>::new().words(0, 0, &input).words(0, 1, &[0; 48]);
    let got = dispatch(&source("flow"), b).0.read_ints(0, 1).unwrap();
    let classify = [10, 20, 20, 40, 30, 30, 30, 30];
    for (l, &x) in a.iter().enumerate() {
        assert_eq!(got[l], classify[l]);
        assert_eq!(got[8 + l], if l == 5 { 2 } else { 1 });
        assert_eq!(got[16 + l], i128::from(collatz(x.abs() + 1)));
        // Steps of two, at least one.
        assert_eq!(got[24 + l], i128::from(((x + 1) / 2 * 2).max(2)));
        assert_eq!(got[32 + l], (0..).find(|k| k * k > i128::from(x)).unwrap());
        assert_eq!(got[40 + l], i128::from(nested(x)));
    }
}

#[test]
fn integers() {
    let (x, y) = (-1000i32, 37i32);
    let (u, v) = (x as u32, y as u32);
    let b = Bindings::<F32>::new().words(0, 0, &[u, v]).words(0, 1, &[0; 32]);
    let got = dispatch(&source("integers"), b).0.read_ints(0, 1).unwrap();
    let byte = |w: u32, k: u32| w >> (8 * k) & 255;
    let signed = |w: u32, k: u32| byte(w, k) as u8 as i8 as i32;
    let dots = (0..4).fold((0u32, 0i32), |d, k| {
        (
            d.0.wrapping_add(byte(u, k) * byte(v, k)),
            d.1 + signed(u, k) * signed(v, k),
        )
    });
    let want: [u32; 32] = [
        (x + y) as u32 ^ (x - y) as u32,
        (x * y) as u32,
        ((x / y) as u32).wrapping_add((x % y) as u32),
        (u & v) | (u << 3),
        ((x >> 2) as u32).wrapping_add(u >> 2),
        !u,
        u.count_ones() + 100 * v.leading_zeros() + 10000 * v.trailing_zeros(),
        v.reverse_bits(),
        // 37 = 0b100101: bits 5 and 0; −1000 = !999, highest differing bit 9.
        5 + 10000 * 9,
        u >> 4 & 255,
        ((u >> 4 & 255) as u8 as i8) as i32 as u32,
        (u & !0xf00) | (v & 15) << 8,
        (x as u32).wrapping_add(y as u32).wrapping_add(-5i32 as u32),
        1000 - 1,
        (2 * x + 3 * y + 4) as u32,
        dots.0.wrapping_add(dots.1 as u32),
        // floor(0.5 + 255 * 0.5) = 128.
        0xffff_8000,
        // −127, floor(0.5 + 63.5) = 64, 127, floor(0.5 − 31.75) = −32.
        0xe07f_4081,
        // floor(0.5 + 65535 / 4) = 16384.
        0xffff_4000,
        // floor(0.5 − 32767 / 4) = −8192 + 0: −8191.25 floored.
        0x7fff_e000,
        0xc000_3c00,
        0x0403_0201 ^ 0x0403_02ff,
        0x04ff_0201 ^ 0x047f_0280,
        byte(u, 0) + byte(u, 3) + (signed(u, 0) + signed(u, 3)) as u32,
        (128.0f32 / 255.0).to_bits() ^ (-1.0f32).to_bits(),
        1.0f32.to_bits() ^ (-1.0f32).to_bits(),
        (-2.0f32).to_bits(),
        3,
        2_147_483_520u32 ^ (-500i32) as u32,
        1 + 2 + 4 + 64,
        1000 + 37.0f32.to_bits(),
        u.wrapping_add(u ^ v),
    ];
    for (k, (&g, &w)) in got.iter().zip(&want).enumerate() {
        assert_eq!(g, i128::from(w), "o[{k}]: {g:#x}, want {w:#x}");
    }
}

#[test]
fn shared() {
    let a: Vec<u32> = (0..128).collect();
    let mut counters = [0u32; 9];
    counters[4] = 127;
    let make = || {
        let b = Bindings::<F32>::new().words(0, 0, &a).words(0, 1, &[0; 8]);
        b.words(0, 2, &counters)
    };
    let (b, _) = dispatch_many(&source("shared"), make(), [2, 1, 1]);
    let sums = [(0..64).sum::<i128>(), (64..128).sum::<i128>()];
    // Lane 0 runs first: it gets 0 from the exchange in the first workgroup and 63, the last lane's value, in the second; it
    // wins the comparison in the first workgroup only, and sees its own 1 in the second.
    assert_eq!(
        b.read_ints(0, 1).unwrap(),
        [sums[0], sums[0], 7, 1, sums[1], sums[1], 8 + 63, 1]
    );
    let xor = (0..64).fold(0, |x, k| x ^ k);
    assert_eq!(
        b.read_ints(0, 2).unwrap(),
        [2 * sums[0], -128, 63, -63, 64, 63, xor, 63, 1]
    );
    let (c, _) = dispatch_many(&source("shared"), make(), [2, 1, 1]);
    assert_eq!(b.buffers, c.buffers, "runs repeat");
}

#[test]
fn wide_types_and_overrides() {
    let (module, info) = crate::common::module(&source("wide"));
    assert!(matches!(
        Program::new(&module, &info, "main"),
        Err(Error::Overrides(_))
    ));
    let constants: PipelineConstants = [("7".to_string(), 10.0)].into_iter().collect();
    let program = Program::with_constants(&module, &info, "main", &constants).unwrap();
    let mut b = Bindings::<F32>::new()
        .floats(0, 0, &[1.0, 3.0])
        .floats(0, 1, &[0.0; 18]);
    run_compute(&program, &mut b, [1, 1, 1], &Limits::default()).unwrap();
    let got = b.read_floats(0, 1).unwrap();
    for l in 0..3 {
        let third = f64::from(half::f16::from_f64(1.0 / 3.0));
        let want = [
            (1.0f64 / 3.0) * 3.0,
            ((5_000_000_000i64 + l as i64) % 7) as f64,
            12.0,
            third,
            40.0,
            6.0,
        ];
        assert_eq!(got[6 * l..6 * l + 6], want);
    }
}

#[test]
fn fragment_quads() {
    let program = program(&source("fragment"));
    // f = x² + 3y at x ∈ {1, 3}, y ∈ {0, 2}.
    let uv = [1.0, 0.0, 3.0, 0.0, 1.0, 2.0, 3.0, 2.0];
    let inputs = StageInputs::<F32>::new(4)
        .position(&[[0.5, 0.5, 0.25, 1.0]; 4])
        .front_facing(&[true, false, true, false])
        .index(Slot::SampleIndex, &[0; 4])
        .index(Slot::SampleMask, &[3; 4])
        .location(0, 2, &uv)
        .index(Slot::Location(1, 0), &[1, 2, 3, 4]);
    let (out, _) = run_fragment(&program, &mut Bindings::new(), &inputs, &Limits::default()).unwrap();
    for k in 0..4 {
        assert_eq!(out.location(0, k).unwrap(), [8.0, 6.0, 14.0, 8.0]);
        assert_eq!(out.location(1, k).unwrap(), [6.0, 8.0, 6.0, 28.0]);
    }
    let depth: Vec<f64> = (0..4)
        .map(|k| out.columns[&Slot::FragDepth].floats(k).unwrap()[0])
        .collect();
    assert_eq!(depth, [0.75, 0.25, 0.75, 0.25]);
    let mask: Vec<_> = (0..4)
        .map(|k| out.columns[&Slot::SampleMask].of(k)[0].int().unwrap())
        .collect();
    assert_eq!(mask, [1, 2, 3, 0]);
    use bossage_bounds::Truth::{False, True};
    assert_eq!(out.discarded, [False, True, False, True]);
    let odd = StageInputs::<F32>::new(3);
    assert!(matches!(
        run_fragment(&program, &mut Bindings::new(), &odd, &Limits::default()),
        Err(Error::Input { .. })
    ));
}

#[test]
fn vertices() {
    let program = program(&source("vertex"));
    let inputs = StageInputs::<F32>::new(2)
        .location(0, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
        .index(Slot::VertexIndex, &[1, 3])
        .index(Slot::InstanceIndex, &[0, 2]);
    let (out, _) = run_vertex(&program, &mut Bindings::new(), &inputs, &Limits::default()).unwrap();
    assert_eq!(
        out.columns[&Slot::Position].floats(1).unwrap(),
        [8.0, 10.0, 12.0, 1.0]
    );
    assert_eq!(out.location(0, 0).unwrap(), [2.0, 0.0]);
    assert_eq!(out.columns[&Slot::Location(1, 0)].of(1)[0].int(), Some(23));
}

#[test]
fn subgroups() {
    let b = Bindings::<F32>::new().words(0, 0, &[0; 14]);
    let got = dispatch(&source("subgroups"), b).0.read_ints(0, 0).unwrap();
    // Invocation 33 is number 1 of subgroup 1 of 32.
    let ids = 0..32u32;
    let sum: u32 = ids.clone().sum();
    let bits = 32 + 31 + ids.fold(0, |x, k| x ^ k);
    // Broadcast 2; across x 0; across y 3; across the diagonal 2.
    let quad = 2 + 100 * 3 + 1000 * 2;
    let want = [
        0xaaaa_aaaa,
        sum,
        1,
        2,
        9,
        31,
        bits,
        3,
        32 + 5,
        2,
        2,
        quad,
        1 + 20,
        2 + 1,
    ];
    assert_eq!(got, want.map(i128::from));
}

/// A subgroup may have any size and members on another machine: the perfect machine's results are among what is accepted.
#[test]
fn subgroups_of_any_size_are_accepted() {
    let got = dispatch::<F32>(&source("subgroups"), Bindings::new().words(0, 0, &[0; 14]))
        .0
        .read_ints(0, 0)
        .unwrap();
    let (wide, _) = dispatch::<Accept>(&source("subgroups"), Bindings::new().words(0, 0, &[0; 14]));
    let Some(BufferData::Scalars(list)) = wide.buffers.get(&(0, 0)) else {
        panic!("a run writes scalars")
    };
    for (k, (scalar, x)) in list.iter().zip(got).enumerate() {
        assert!(
            matches!(*scalar, Scalar::Int(lo, hi) if lo <= x && x <= hi),
            "o[{k}]: {x} not in {scalar:?}"
        );
    }
    let source = "@group(0) @binding(0) var<storage, read_write> o: array<u32>;
        @compute @workgroup_size(64) fn main(@builtin(local_invocation_index) l: u32) {
            let all = u32(subgroupAll(l < 64u));
            let most = subgroupMax(l % 8u);
            let some = u32(subgroupAll(l < 8u));
            if (l == 0u) { o[0] = all; o[1] = most; o[2] = some; }
        }";
    let (tight, _) = dispatch::<Accept>(source, Bindings::new().words(0, 0, &[9; 3]));
    let Some(BufferData::Scalars(list)) = tight.buffers.get(&(0, 0)) else {
        panic!("a run writes scalars")
    };
    // Decided where all invocations agree, bounded where they do not, open where the members decide.
    assert_eq!(
        list[..],
        [Scalar::Int(1, 1), Scalar::Int(0, 7), Scalar::Int(0, 1)]
    );
}
