//! Packs named values into the bytes of a uniform block, at the offsets that the manifest states.
//!
//! A value's name is the path of a member: `object.clip_from_local`, `lights.items[2].vector`; where the variable is no struct,
//! the variable's name alone. A value may also be given for a whole array or struct: its numbers then fill the members
//! below it in order, without padding. Matrices go column by column. Bytes between members are zero.

use std::collections::BTreeMap;

use bossage_translate::manifest::{ArrayShape, Block, Member, Value};

use crate::error::Error;

/// The bytes of a block.
pub(crate) fn pack(job: &str, block: &Block, values: &BTreeMap<String, Vec<f32>>) -> Result<Vec<u8>, Error> {
    let mut packer = Packer {
        job,
        values,
        bytes: vec![0; block.size as usize],
    };
    packer.member(&block.name, &as_member(block), 0)?;
    Ok(packer.bytes)
}

/// The block as a member of nothing: a struct of its members, or its one member where it is no struct.
fn as_member(block: &Block) -> Member {
    match block.members.as_slice() {
        [only] if only.name.is_empty() => only.clone(),
        members => Member {
            name: String::new(),
            ty: block.name.clone(),
            offset: 0,
            size: block.size,
            value: None,
            array: None,
            members: members.to_vec(),
        },
    }
}

/// A scalar, vector or matrix at its place in the block.
struct Leaf<'a> {
    value: &'a Value,
    offset: u32,
}

struct Packer<'a> {
    job: &'a str,
    values: &'a BTreeMap<String, Vec<f32>>,
    bytes: Vec<u8>,
}

impl Packer<'_> {
    /// Writes the value that is given for this member, or else those of the members below it.
    fn member(&mut self, path: &str, member: &Member, base: u32) -> Result<(), Error> {
        if let Some(numbers) = self.values.get(path) {
            return self.write(path, &leaves(member, base), numbers);
        }
        let children = children(path, member, base);
        if children.is_empty() {
            let (job, kind) = (self.job.to_owned(), member.ty.clone());
            return Err(Error::MissingUniform {
                job,
                member: path.to_owned(),
                kind,
            });
        }
        children
            .iter()
            .try_for_each(|(path, child, base)| self.member(path, child, *base))
    }

    fn write(&mut self, path: &str, leaves: &[Leaf<'_>], numbers: &[f32]) -> Result<(), Error> {
        let length = |leaf: &Leaf<'_>| (leaf.value.rows * leaf.value.columns) as usize;
        let expected: usize = leaves.iter().map(length).sum();
        if numbers.len() != expected {
            return Err(self.bad(
                path,
                format!("{} numbers are given, it has {expected}", numbers.len()),
            ));
        }
        let mut rest = numbers;
        for leaf in leaves {
            let (own, after) = rest.split_at(length(leaf));
            self.leaf(path, leaf, own)?;
            rest = after;
        }
        Ok(())
    }

    fn leaf(&mut self, path: &str, leaf: &Leaf<'_>, numbers: &[f32]) -> Result<(), Error> {
        for (column, numbers) in numbers.chunks(leaf.value.rows.max(1) as usize).enumerate() {
            let mut at = leaf.offset as usize + column * leaf.value.column_stride as usize;
            for number in numbers {
                let (bytes, width) =
                    scalar(&leaf.value.scalar, *number).map_err(|why| self.bad(path, why))?;
                let Some(place) = self.bytes.get_mut(at..at + width) else {
                    return Err(self.bad(path, format!("offset {at} lies outside of the block")));
                };
                place.copy_from_slice(&bytes[..width]);
                at += width;
            }
        }
        Ok(())
    }

    fn bad(&self, path: &str, problem: String) -> Error {
        Error::BadUniform {
            job: self.job.to_owned(),
            member: path.to_owned(),
            problem,
        }
    }
}

/// A member's elements or members, each with its path and the offset that its own offset counts from.
fn children(path: &str, member: &Member, base: u32) -> Vec<(String, Member, u32)> {
    let start = base + member.offset;
    match member.array {
        Some(ArrayShape { count, stride }) => {
            let element = Member {
                offset: 0,
                array: None,
                ..member.clone()
            };
            (0..count)
                .map(|index| {
                    (
                        format!("{path}[{index}]"),
                        element.clone(),
                        start + index * stride,
                    )
                })
                .collect()
        }
        None => member
            .members
            .iter()
            .map(|child| (format!("{path}.{}", child.name), child.clone(), start))
            .collect(),
    }
}

/// All scalars, vectors and matrices of a member, in order.
fn leaves(member: &Member, base: u32) -> Vec<Leaf<'_>> {
    let start = base + member.offset;
    let (count, stride) = member.array.map_or((1, 0), |array| (array.count, array.stride));
    let starts = (0..count).map(|index| start + index * stride);
    starts.flat_map(|offset| element_leaves(member, offset)).collect()
}

fn element_leaves(member: &Member, offset: u32) -> Vec<Leaf<'_>> {
    match &member.value {
        Some(value) => vec![Leaf { value, offset }],
        None => member
            .members
            .iter()
            .flat_map(|child| leaves(child, offset))
            .collect(),
    }
}

/// A number as a scalar of that type: its bytes, and how many of them count.
fn scalar(kind: &str, number: f32) -> Result<([u8; 4], usize), String> {
    let whole = |low: f64, high: f64| {
        let fits = number.fract() == 0.0 && (low..=high).contains(&f64::from(number));
        fits.then_some(()).ok_or_else(|| format!("{number} is no {kind}"))
    };
    match kind {
        "f32" => Ok((number.to_le_bytes(), 4)),
        "u32" => whole(0.0, f64::from(u32::MAX)).map(|()| ((number as u32).to_le_bytes(), 4)),
        "i32" => whole(f64::from(i32::MIN), f64::from(i32::MAX)).map(|()| ((number as i32).to_le_bytes(), 4)),
        "f16" => {
            let [low, high] = half::f16::from_f32(number).to_le_bytes();
            Ok(([low, high, 0, 0], 2))
        }
        other => Err(format!("the runner can't write a {other}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(scalar: &str, rows: u32, columns: u32, column_stride: u32) -> Option<Value> {
        Some(Value {
            scalar: scalar.to_owned(),
            rows,
            columns,
            column_stride,
        })
    }

    fn leaf(name: &str, offset: u32, size: u32, value: Option<Value>) -> Member {
        Member {
            name: name.into(),
            ty: "?".into(),
            offset,
            size,
            value,
            array: None,
            members: vec![],
        }
    }

    /// `struct { count: vec2u, m: mat2x3f, items: array<struct { a: f32, b: vec2f }, 2> }`, offsets by WGSL's rules:
    /// mat2x3f aligns to 16 with columns of stride 16 (size 32), the element aligns to 8 and is 16 long.
    fn block() -> Block {
        let items = Member {
            array: Some(ArrayShape { count: 2, stride: 16 }),
            members: vec![
                leaf("a", 0, 4, value("f32", 1, 1, 4)),
                leaf("b", 8, 8, value("f32", 2, 1, 8)),
            ],
            ..leaf("items", 48, 32, None)
        };
        let members = vec![
            leaf("count", 0, 8, value("u32", 2, 1, 8)),
            leaf("m", 16, 32, value("f32", 3, 2, 16)),
            items,
        ];
        Block {
            name: "u".into(),
            group: 0,
            binding: 0,
            size: 80,
            members,
        }
    }

    fn values(pairs: &[(&str, &[f32])]) -> BTreeMap<String, Vec<f32>> {
        pairs
            .iter()
            .map(|(name, numbers)| ((*name).to_owned(), numbers.to_vec()))
            .collect()
    }

    fn word(bytes: &[u8], at: usize) -> f32 {
        f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    }

    #[test]
    fn members_land_at_their_offsets_column_by_column() {
        let given = values(&[
            ("u.count", &[7.0, 9.0]),
            ("u.m", &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
            ("u.items[0].a", &[10.0]),
            ("u.items[0].b", &[11.0, 12.0]),
            ("u.items[1]", &[20.0, 21.0, 22.0]),
            ("u.unused", &[1.0]),
        ]);
        let bytes = pack("test", &block(), &given).unwrap();
        assert_eq!(bytes.len(), 80);
        assert_eq!(bytes[0..8], [7, 0, 0, 0, 9, 0, 0, 0]);
        let floats: Vec<f32> = (16..80).step_by(4).map(|at| word(&bytes, at)).collect();
        let expected = [
            1.0, 2.0, 3.0, 0.0, 4.0, 5.0, 6.0, 0.0, 10.0, 0.0, 11.0, 12.0, 20.0, 0.0, 21.0, 22.0,
        ];
        assert_eq!(floats, expected);
    }

    #[test]
    fn a_whole_array_fills_as_its_elements_do() {
        let whole = values(&[
            ("u.count", &[1.0, 2.0]),
            ("u.m", &[0.0; 6]),
            ("u.items", &[1., 2., 3., 4., 5., 6.]),
        ]);
        let single = values(&[
            ("u.count", &[1.0, 2.0]),
            ("u.m", &[0.0; 6]),
            ("u.items[0]", &[1., 2., 3.]),
            ("u.items[1]", &[4., 5., 6.]),
        ]);
        assert_eq!(
            pack("a", &block(), &whole).unwrap(),
            pack("b", &block(), &single).unwrap()
        );
    }

    #[test]
    fn a_whole_struct_fills_as_its_members_do() {
        let numbers: Vec<f32> = (0..14).map(|index| index as f32).collect();
        let whole = values(&[("u", &numbers)]);
        let apart = values(&[
            ("u.count", &numbers[..2]),
            ("u.m", &numbers[2..8]),
            ("u.items", &numbers[8..]),
        ]);
        assert_eq!(
            pack("a", &block(), &whole).unwrap(),
            pack("b", &block(), &apart).unwrap()
        );
    }

    #[test]
    fn a_missing_member_is_named() {
        let given = values(&[
            ("u.count", &[1.0, 2.0]),
            ("u.m", &[0.0; 6]),
            ("u.items[0]", &[0.0; 3]),
        ]);
        let error = pack("job", &block(), &given).unwrap_err();
        assert!(
            matches!(&error, Error::MissingUniform { member, .. } if member == "u.items[1].a"),
            "{error}"
        );
    }

    #[test]
    fn wrong_length_and_wrong_number_are_refused() {
        let short = values(&[("u.count", &[1.0])]);
        let error = pack("job", &block(), &short).unwrap_err().to_string();
        assert_eq!(error, "`job`: uniform `u.count`: 1 numbers are given, it has 2");
        for wrong in [-1.0, 0.5, f32::NAN, f32::INFINITY, 4_294_967_296.0] {
            let given = values(&[("u.count", &[wrong, 0.0])]);
            assert!(
                matches!(pack("job", &block(), &given), Err(Error::BadUniform { .. })),
                "{wrong}"
            );
        }
    }

    #[test]
    fn halves_take_two_bytes_each() {
        let member = leaf("", 0, 4, value("f16", 2, 1, 4));
        let block = Block {
            name: "h".into(),
            group: 0,
            binding: 0,
            size: 4,
            members: vec![member],
        };
        let bytes = pack("job", &block, &values(&[("h", &[1.0, -2.0])])).unwrap();
        assert_eq!(bytes, [0x00, 0x3c, 0x00, 0xc0]);
    }
}
