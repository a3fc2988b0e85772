//! How buffers lie in memory: WGSL's rules as naga applied them, taken from the IR and not computed again.

use naga::proc::Layouter;
use naga::{ArraySize, Handle, Module, Type, TypeInner};

use crate::ir;
use crate::manifest::{ArrayShape, Block, Member, Value};
use crate::resources::Resource;
use crate::shader::Unit;
use crate::type_name::{scalar_name, type_name};

/// The layout of a buffer.
pub(super) fn block(unit: &Unit, resource: &Resource) -> Block {
    let (size, members) = members(unit, resource.ty);
    Block {
        name: resource.name.clone(),
        group: resource.group,
        binding: resource.binding,
        size,
        members,
    }
}

/// Size and members of a type; anything but a struct has one member without a name.
pub(super) fn members(unit: &Unit, ty: Handle<Type>) -> (u32, Vec<Member>) {
    let reader = Reader::new(&unit.module);
    let members = match reader.module.types[ty].inner {
        TypeInner::Struct { .. } => reader.struct_members(ty),
        _ => vec![reader.member("", ty, 0)],
    };
    (reader.layouter[ty].size, members)
}

struct Reader<'a> {
    module: &'a Module,
    layouter: Layouter,
}

impl<'a> Reader<'a> {
    fn new(module: &'a Module) -> Self {
        let mut layouter = Layouter::default();
        // The module is valid, so every type has a layout.
        let laid_out = layouter.update(module.to_ctx());
        debug_assert!(laid_out.is_ok());
        Self { module, layouter }
    }

    fn struct_members(&self, ty: Handle<Type>) -> Vec<Member> {
        let TypeInner::Struct { members, .. } = &self.module.types[ty].inner else {
            return Vec::new();
        };
        members
            .iter()
            .map(|m| self.member(m.name.as_deref().unwrap_or_default(), m.ty, m.offset))
            .collect()
    }

    fn member(&self, name: &str, ty: Handle<Type>, offset: u32) -> Member {
        let (element, array) = self.element(ty);
        Member {
            name: name.to_owned(),
            ty: type_name(self.module, ty),
            offset,
            size: self.layouter[ty].size,
            value: self.value(element),
            array,
            members: self.struct_members(element),
        }
    }

    /// The element of an array, and the array's shape.
    fn element(&self, ty: Handle<Type>) -> (Handle<Type>, Option<ArrayShape>) {
        let TypeInner::Array { base, size, stride } = self.module.types[ty].inner else {
            return (ty, None);
        };
        let count = match size {
            ArraySize::Constant(count) => count.get(),
            ArraySize::Pending(_) | ArraySize::Dynamic => 0,
        };
        (base, Some(ArrayShape { count, stride }))
    }

    fn value(&self, ty: Handle<Type>) -> Option<Value> {
        let inner = &self.module.types[ty].inner;
        let scalar = ir::scalar_of(inner)?;
        let (rows, columns) = match *inner {
            TypeInner::Vector { size, .. } => (size as u32, 1),
            TypeInner::Matrix { columns, rows, .. } => (rows as u32, columns as u32),
            _ => (1, 1),
        };
        Some(Value {
            scalar: scalar_name(scalar),
            rows,
            columns,
            column_stride: self.layouter[ty].size / columns,
        })
    }
}
