0 BEGIN PGM main INCH
1 ; The tool has drifted: the preset stays, the kinematics move. A programmed M128 lets the probe circle.
2 TOOL CALL 30 Z
3 L X+0 Y+0 FMAX
4 L Z+2 FMAX M128
5 TCH PROBE 452 PRESET COMPENSATION ~
    Q407=+0.5905512 ;SPHERE RADIUS ~
    Q320=+0   ;SET-UP CLEARANCE ~
    Q408=+0   ;RETR. HEIGHT ~
    Q253=MAX  ;F PRE-POSITIONING ~
    Q380=+0   ;REFERENCE ANGLE ~
    Q411=-60  ;START ANGLE A ~
    Q412=+60  ;END ANGLE A ~
    Q413=+0   ;INCID. ANGLE A ~
    Q414=+3   ;MEAS. POINTS A ~
    Q418=+0   ;MEAS. POINTS B ~
    Q419=+90  ;START ANGLE C ~
    Q420=+270 ;END ANGLE C ~
    Q421=+0   ;INCID. ANGLE C ~
    Q422=+3   ;MEAS. POINTS C ~
    Q423=+3   ;NO. OF PROBE POINTS ~
    Q432=+1   ;BACKLASH, ANG. RANGE
6 END PGM main INCH
