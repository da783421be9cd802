; run: failed line 5: Tool number not permitted: tool 5 is not a touch probe: set its TP_NO
BEGIN PGM BAD MM
TOOL DEF 5 L+100 R+6
TOOL CALL 5 Z
TCH PROBE 460 CALIBRATION OF TS ON A SPHERE ~
    Q407=+12.5
END PGM BAD MM
