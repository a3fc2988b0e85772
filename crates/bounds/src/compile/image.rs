//! Texture expressions.

use super::builder::{Builder, Frame, Val};
use super::code::{ImageLoad, ImageQuery, Level, Op, Query, Sample};
use super::layout::unsupported;
use crate::error::Result;
use crate::kind::{IntType, Kind};
use naga::{Expression, Handle, SampleLevel, Span};

impl<'m> Builder<'m> {
    pub(crate) fn image_sample(
        &mut self,
        frame: &mut Frame<'m>,
        handle: Handle<Expression>,
        span: Span,
    ) -> Result<Val> {
        let Expression::ImageSample {
            image,
            sampler,
            gather,
            coordinate,
            array_index,
            offset,
            level,
            depth_ref,
            clamp_to_edge,
        } = frame.function.expressions[handle]
        else {
            return unsupported("another expression", span);
        };
        let kind = self.kind_of(frame, handle)?;
        let parts = self.types.scalars(self.type_of(frame, handle))?;
        let level = self.level(frame, level)?;
        self.code.uses_derivatives |= matches!(level, Level::Auto | Level::Bias(_));
        let mut sample = Sample {
            image: self.value(frame, image)?.handle(span)?,
            sampler: self.value(frame, sampler)?.handle(span)?,
            coordinate: self.scalars(frame, coordinate)?,
            layer: array_index.map(|h| self.integer(frame, h)).transpose()?,
            offset: offset
                .map(|h| self.scalars(frame, h))
                .transpose()?
                .unwrap_or_default(),
            level,
            gather: gather.map(|c| c as u8),
            reference: depth_ref.map(|h| self.scalar(frame, h)).transpose()?,
            clamp_to_edge,
            dst: 0,
            parts,
            kind,
        };
        let rows = self.rows(frame, &vec![kind; parts as usize]);
        sample.dst = rows[0];
        self.push(frame, Op::Sample(Box::new(sample)))?;
        Ok(Val::Rows(rows))
    }

    fn level(&mut self, frame: &mut Frame<'m>, level: SampleLevel) -> Result<Level> {
        Ok(match level {
            SampleLevel::Auto => Level::Auto,
            SampleLevel::Zero => Level::Zero,
            SampleLevel::Exact(h) => match self.kind_of(frame, h)? {
                Kind::Int(t) => Level::ExactInt(self.scalar(frame, h)?, t),
                Kind::Float(_) | Kind::Bool => Level::Exact(self.scalar(frame, h)?),
            },
            SampleLevel::Bias(h) => Level::Bias(self.scalar(frame, h)?),
            SampleLevel::Gradient { x, y } => Level::Gradient {
                x: self.scalars(frame, x)?,
                y: self.scalars(frame, y)?,
            },
        })
    }

    pub(crate) fn image_load(
        &mut self,
        frame: &mut Frame<'m>,
        handle: Handle<Expression>,
        span: Span,
    ) -> Result<Val> {
        let Expression::ImageLoad {
            image,
            coordinate,
            array_index,
            sample,
            level,
        } = frame.function.expressions[handle]
        else {
            return unsupported("another expression", span);
        };
        let kind = self.kind_of(frame, handle)?;
        let parts = self.types.scalars(self.type_of(frame, handle))?;
        let (image, coordinate, layer) = self.texel(frame, image, coordinate, array_index, span)?;
        let sample = sample.map(|h| self.integer(frame, h)).transpose()?;
        let level = level.map(|h| self.integer(frame, h)).transpose()?;
        let rows = self.rows(frame, &vec![kind; parts as usize]);
        let load = ImageLoad {
            image,
            coordinate,
            layer,
            sample,
            level,
            dst: rows[0],
            parts,
            kind,
        };
        self.push(frame, Op::ImageLoad(Box::new(load)))?;
        Ok(Val::Rows(rows))
    }

    pub(crate) fn image_query(
        &mut self,
        frame: &mut Frame<'m>,
        image: Handle<Expression>,
        query: naga::ImageQuery,
        span: Span,
    ) -> Result<Val> {
        let dim = match *self.type_of(frame, image) {
            naga::TypeInner::Image { dim, .. } => dim,
            naga::TypeInner::Scalar(_)
            | naga::TypeInner::Vector { .. }
            | naga::TypeInner::Matrix { .. }
            | naga::TypeInner::Atomic(_)
            | naga::TypeInner::Array { .. }
            | naga::TypeInner::Struct { .. }
            | naga::TypeInner::Pointer { .. }
            | naga::TypeInner::ValuePointer { .. }
            | naga::TypeInner::CooperativeMatrix { .. }
            | naga::TypeInner::AccelerationStructure { .. }
            | naga::TypeInner::RayQuery { .. }
            | naga::TypeInner::Sampler { .. }
            | naga::TypeInner::BindingArray { .. } => {
                return unsupported("a query of something else than a texture", span);
            }
        };
        let image = self.value(frame, image)?.handle(span)?;
        let (query, level, parts) = match query {
            naga::ImageQuery::Size { level } => (
                Query::Size,
                level.map(|h| self.integer(frame, h)).transpose()?,
                size_parts(dim),
            ),
            naga::ImageQuery::NumLevels => (Query::Levels, None, 1),
            naga::ImageQuery::NumLayers => (Query::Layers, None, 1),
            naga::ImageQuery::NumSamples => (Query::Samples, None, 1),
        };
        let rows = self.rows(frame, &vec![Kind::Int(IntType::U32); parts as usize]);
        self.push(
            frame,
            Op::ImageQuery(Box::new(ImageQuery {
                image,
                query,
                level,
                dst: rows[0],
                parts,
            })),
        )?;
        Ok(Val::Rows(rows))
    }
}

fn size_parts(dim: naga::ImageDimension) -> u32 {
    match dim {
        naga::ImageDimension::D1 => 1,
        naga::ImageDimension::D2 | naga::ImageDimension::Cube => 2,
        naga::ImageDimension::D3 => 3,
    }
}
