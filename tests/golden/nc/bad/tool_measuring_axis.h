; run: failed line 5: Tool axis not allowed: the TT is touched along Z
BEGIN PGM BAD MM
TOOL DEF 5 L+100 R+6
TOOL CALL 5 Y
TCH PROBE 483 MEASURE TOOL ~
    Q340=+1 ~
    Q260=+100 ~
    Q341=+0
END PGM BAD MM
