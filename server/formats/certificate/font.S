// The font of certificates, compiled in: DejaVu Sans, which may be embedded and passed on.
  .section .rodata
  .global fitgauge_font_begin
  .global fitgauge_font_end
  .balign 16
fitgauge_font_begin:
  .incbin FITGAUGE_FONT
fitgauge_font_end:
  .byte 0
  .section .note.GNU-stack, "", %progbits
